#include "server/net/http/upload.h"

#include "protocol/base/text/names.h"
#include "protocol/light/environment_error.h"
#include "server/net/http/query_rules.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace relume::net {

using wire::ErrorCode;
using wire::WireError;

namespace {

constexpr std::size_t kMostLayerBytes = 1024;
// A map with its pyramid, as EnvironmentMap keeps it.
constexpr std::uint64_t kBytesPerTexel = 16;
// What a decoder takes before it has read a byte: its program and libraries, mapped.
constexpr std::uint64_t kDecoderBytes = std::uint64_t{256} << 20;

}  // namespace

decoder::DecodeLimits Uploads::decode_limits(std::stop_token stop) const {
    decoder::DecodeLimits limits;
    limits.max_file_bytes = options_.file_bytes;
    limits.max_texels = std::min(options_.texels, options_.memory_bytes / kBytesPerTexel);
    limits.address_space_bytes = kDecoderBytes + options_.file_bytes + options_.memory_bytes;
    limits.stop = std::move(stop);
    limits.program = options_.decoder;
    return limits;
}

std::variant<HttpReply, Upload> Uploads::admit(const HttpRequest& request) {
    if (!access_.allows_origin(request)) {
        return error_reply(403, WireError(ErrorCode::unsupported, "Origin", *request.origin,
                                          "the server's own origin or an allowed one"));
    }
    if (access_.role_of(request) == Role::none) {
        return error_reply(401, WireError(ErrorCode::unsupported, "token",
                                          "no or another token", "the server's token"));
    }
    if (auto fault = fault_of_query(request.target,
                                    {"name", "projection", "centre", "layer", "token"})) {
        return *std::move(fault);
    }
    const std::optional<std::string> name = request.target.parameter("name");
    if (!name) {
        return error_reply(400, WireError(ErrorCode::missing_field, "name", "nothing",
                                          std::string(text::kNameRule)));
    }
    if (!text::is_name(*name)) {
        return error_reply(400, WireError(ErrorCode::out_of_range, "name", *name,
                                          std::string(text::kNameRule)));
    }
    Upload upload{.name = *name, .options = {}, .place = {}, .place_of_address = {}};
    if (const auto projection = request.target.parameter("projection")) {
        upload.options.projection = light::projection_from_string(*projection);
        if (!upload.options.projection) {
            return error_reply(400,
                               WireError(ErrorCode::unknown_name, "projection", *projection,
                                         "lat_long, vertical_cross, horizontal_cross, "
                                         "angular_map or cubemap_strip"));
        }
    }
    if (const auto centre = request.target.parameter("centre")) {
        const auto known = light::map_centre_from_string(*centre);
        if (!known) {
            return error_reply(400, WireError(ErrorCode::unknown_name, "centre", *centre,
                                              std::string(light::map_centre_names())));
        }
        upload.options.centre = *known;
    }
    if (const auto layer = request.target.parameter("layer")) {
        if (layer->size() > kMostLayerBytes) {
            return error_reply(400, WireError(ErrorCode::too_large, "layer",
                                              fmt::format("{} bytes", layer->size()),
                                              fmt::format("at most {}", kMostLayerBytes)));
        }
        upload.options.layer = *layer;
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
    const auto busy = [](std::size_t count, const char* whose) {
        HttpReply reply =
            error_reply(503, WireError(ErrorCode::too_many, "",
                                       fmt::format("{} uploads{} in progress", count, whose),
                                       "this request again in a moment"));
        reply.headers.emplace_back("Retry-After", "1");
        return reply;
    };
    upload.place_of_address = by_address_.take(request.client);
    if (!upload.place_of_address) {
        return busy(options_.per_address, " from this address");
    }
    if (in_progress_->fetch_add(1) >= options_.concurrent) {
        in_progress_->fetch_sub(1);
        return busy(options_.concurrent, "");
    }
    upload.place =
        std::shared_ptr<void>(nullptr, [count = in_progress_](void*) { count->fetch_sub(1); });
    return upload;
}

HttpReply Uploads::finish(const Upload& upload,
                          std::span<const std::byte> body,
                          std::stop_token stop) {
    std::stop_source either;
    const auto end = [&either] { either.request_stop(); };
    const std::stop_callback with_client(std::move(stop), end);
    const std::stop_callback with_server(stop_.get_token(), end);
    try {
        light::ImportedEnvironment imported =
            decoder::decode_in_child(body, upload.options, decode_limits(either.get_token()));
        const nlohmann::json answer{{"name", upload.name},
                                    {"width", imported.map.width()},
                                    {"height", imported.map.height()},
                                    {"projection", light::to_string(imported.map.projection())},
                                    {"centre", light::to_string(imported.map.centre())},
                                    {"layer", imported.notes.layer},
                                    {"layers", imported.notes.layers},
                                    {"warnings", imported.notes.warnings}};
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
