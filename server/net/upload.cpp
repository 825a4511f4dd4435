#include "server/net/upload.h"

#include "protocol/wire/names.h"
#include "server/light/environment_error.h"
#include "server/light/sandboxed_decoder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <utility>

namespace relume::net {

using wire::ErrorCode;
using wire::WireError;

std::variant<HttpReply, Upload> Uploads::admit(const HttpRequest& request) {
    if (!access_.allows_origin(request)) {
        return error_reply(403, WireError(ErrorCode::unsupported, "Origin", *request.origin,
                                          "the server's own origin or an allowed one"));
    }
    if (!access_.has_token(request)) {
        return error_reply(401, WireError(ErrorCode::unsupported, "token",
                                          "no or another token", "the server's token"));
    }
    const std::optional<std::string> name = request.target.parameter("name");
    if (!name) {
        return error_reply(400, WireError(ErrorCode::missing_field, "name", "nothing",
                                          std::string(wire::kNameRule)));
    }
    if (!wire::is_name(*name)) {
        return error_reply(400, WireError(ErrorCode::out_of_range, "name", *name,
                                          std::string(wire::kNameRule)));
    }
    Upload upload{.name = *name, .projection = {}, .place = {}};
    if (const auto projection = request.target.parameter("projection")) {
        upload.projection = light::projection_from_string(*projection);
        if (!upload.projection) {
            return error_reply(400,
                               WireError(ErrorCode::unknown_name, "projection", *projection,
                                         "lat_long, vertical_cross, horizontal_cross, "
                                         "angular_map or cubemap_strip"));
        }
    }
    if (!request.content_length) {
        return error_reply(411, WireError(ErrorCode::missing_field, "Content-Length", "nothing",
                                          "the length of the file in bytes"));
    }
    if (*request.content_length > options_.file_bytes) {
        return error_reply(413, WireError(ErrorCode::too_large, "Content-Length",
                                          fmt::format("{} bytes", *request.content_length),
                                          fmt::format("at most {}", options_.file_bytes)));
    }
    try {
        library_.check_upload_name(*name);
    } catch (const WireError& refusal) {
        return error_reply(409, refusal);
    }
    if (in_progress_->fetch_add(1) >= options_.concurrent) {
        in_progress_->fetch_sub(1);
        HttpReply reply = error_reply(
            503, WireError(ErrorCode::too_many, "",
                           fmt::format("{} uploads in progress", options_.concurrent),
                           "this request again in a moment"));
        reply.headers.emplace_back("Retry-After", "1");
        return reply;
    }
    upload.place =
        std::shared_ptr<void>(nullptr, [count = in_progress_](void*) { count->fetch_sub(1); });
    return upload;
}

HttpReply Uploads::finish(const Upload& upload, std::span<const std::byte> body) {
    light::DecodeLimits limits;
    limits.max_file_bytes = options_.file_bytes;
    limits.max_texels = options_.texels;
    limits.program = options_.decoder;
    try {
        light::ImportedEnvironment imported =
            light::decode_in_child(body, upload.projection, limits);
        const nlohmann::json answer{{"name", upload.name},
                                    {"width", imported.map.width()},
                                    {"height", imported.map.height()},
                                    {"projection", light::to_string(imported.map.projection())},
                                    {"warnings", imported.warnings}};
        library_.add_upload(upload.name, std::move(imported.map));
        spdlog::info("environment_uploaded name={} bytes={} width={} height={}", upload.name,
                     body.size(), answer["width"].get<unsigned>(),
                     answer["height"].get<unsigned>());
        return json_reply(201, answer.dump());
    } catch (const light::EnvironmentError& refusal) {
        spdlog::warn("upload_refused name={} bytes={} reason={:?}", upload.name, body.size(),
                     refusal.what());
        return error_reply(
            422, WireError(ErrorCode::bad_image, "body",
                           refusal.found().empty() ? refusal.what() : refusal.found(),
                           refusal.expected().empty() ? "a Radiance HDR or OpenEXR file"
                                                      : refusal.expected()));
    } catch (const WireError& refusal) {
        return error_reply(refusal.code() == ErrorCode::too_many ? 507 : 409, refusal);
    }
}

}  // namespace relume::net
