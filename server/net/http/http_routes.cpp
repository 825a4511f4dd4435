#include "server/net/http/http_routes.h"

#include "server/net/base/log_sink.h"
#include "server/net/http/query_rules.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace relume::net {

using wire::ErrorCode;
using wire::WireError;

namespace {

constexpr std::string_view kSessionPrefix = "/session/";
constexpr std::string_view kEnvironmentsPath = "/api/environments";

// NAME in prefix NAME suffix.
std::optional<std::string_view> name_between(std::string_view path,
                                             std::string_view prefix,
                                             std::string_view suffix) {
    if (path.size() < prefix.size() + suffix.size() || !path.starts_with(prefix) ||
        !path.ends_with(suffix)) {
        return std::nullopt;
    }
    path.remove_prefix(prefix.size());
    path.remove_suffix(suffix.size());
    return path;
}

std::optional<std::string_view> preview_name(std::string_view path) {
    return name_between(path, "/api/environments/", "/preview.jpg");
}

struct ScenePicturePath {
    std::string_view scene;
    ScenePicture picture;
};

std::optional<ScenePicturePath> scene_picture(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string_view::npos) {
        return std::nullopt;
    }
    const auto picture = kScenePictures.value(path.substr(slash + 1));
    const auto name = name_between(path, "/api/scenes/", path.substr(slash));
    return picture && name ? std::optional(ScenePicturePath{*name, *picture}) : std::nullopt;
}

// The page reads the query of its own address, and a request to enter a room has rules of its
// own; no other path takes parameters.
bool may_have_parameters(std::string_view path) {
    return path.starts_with(kSessionPrefix) ||
           !(path.starts_with("/api/") || path == "/healthz" || path == "/readyz" ||
             path == "/metrics");
}

HttpReply not_found(std::string_view what, std::string_view expected) {
    return error_reply(
        404, WireError(ErrorCode::not_found, "", std::string(what), std::string(expected)));
}

HttpReply image_reply(std::string content_type, std::shared_ptr<const std::string> body) {
    return {.status = 200,
            .content_type = std::move(content_type),
            .body = std::move(body),
            .headers = {{"Cache-Control", "no-cache"}}};
}

}  // namespace

HttpRoutes::HttpRoutes(const SceneLibrary& scenes,
                       const Libraries& libraries,
                       const StaticFiles& files,
                       const Access& access,
                       const Readiness& readiness,
                       Metrics& metrics)
    : scenes_(scenes),
      environments_(libraries.environments),
      materials_(libraries.materials),
      files_(files),
      access_(access),
      readiness_(readiness),
      metrics_(metrics) {}

bool HttpRoutes::takes_long(const HttpRequest& request) {
    return preview_name(request.target.path) || scene_picture(request.target.path);
}

std::optional<std::string> HttpRoutes::room_of(const HttpRequest& request) {
    const auto name = name_between(request.target.path, kSessionPrefix, "");
    return name ? std::optional<std::string>(*name) : std::nullopt;
}

bool HttpRoutes::is_upload(const HttpRequest& request) {
    return request.method == HttpMethod::post && request.target.path == kEnvironmentsPath;
}

HttpReply HttpRoutes::answer(const HttpRequest& request) const {
    const std::string& path = request.target.path;
    if (request.method == HttpMethod::options) {
        HttpReply reply{.status = 204, .content_type = {}, .headers = {}};
        if (access_.must_name_origin(request)) {
            reply.headers = {{"Access-Control-Allow-Methods", "GET, HEAD, POST"},
                             {"Access-Control-Allow-Headers", "Content-Type, Authorization"},
                             {"Access-Control-Max-Age", "600"}};
        }
        return reply;
    }
    if (request.method != HttpMethod::get && request.method != HttpMethod::head) {
        HttpReply reply = error_reply(
            405, WireError(ErrorCode::unsupported, "", "another method", "GET or HEAD"));
        reply.headers.emplace_back("Allow",
                                   path == kEnvironmentsPath ? "GET, HEAD, POST" : "GET, HEAD");
        return reply;
    }
    if (!may_have_parameters(path)) {
        if (std::optional<HttpReply> fault = fault_of_query(request.target, {})) {
            return *std::move(fault);
        }
    }
    if (path == "/healthz") {
        return text_reply(200, "ok\n");
    }
    if (path == "/readyz") {
        return readyz();
    }
    if (path == "/metrics") {
        return metrics();
    }
    if (path.starts_with("/api/")) {
        return answer_api(request);
    }
    if (path.starts_with(kSessionPrefix)) {
        HttpReply reply = error_reply(426, WireError(ErrorCode::unsupported, "Upgrade",
                                                     "a plain request", "a WebSocket upgrade"));
        reply.headers.emplace_back("Upgrade", "websocket");
        return reply;
    }
    return file(request);
}

HttpReply HttpRoutes::answer_api(const HttpRequest& request) const {
    const std::string& path = request.target.path;
    if (path == "/api/scenes") {
        return scenes();
    }
    if (path == kEnvironmentsPath) {
        return environments();
    }
    if (path == "/api/materials") {
        return materials();
    }
    if (const auto asked = scene_picture(path)) {
        return picture(asked->scene, asked->picture);
    }
    if (const auto name = preview_name(path)) {
        return preview(*name);
    }
    return not_found(path, "a path of protocol/README.md §3");
}

HttpReply HttpRoutes::readyz() const {
    switch (readiness_.phase()) {
        case Readiness::Phase::ready:
            return text_reply(200, "ready\n");
        case Readiness::Phase::starting:
            return text_reply(503, "starting\n");
        case Readiness::Phase::draining:
            break;
    }
    return text_reply(503, "draining\n");
}

HttpReply HttpRoutes::metrics() const {
    metrics_.set_environment_bytes(environments_.resident_bytes());
    metrics_.set_material_bytes(materials_.resident_bytes());
    metrics_.set_dropped_log_lines(dropped_log_lines());
    HttpReply reply = text_reply(200, metrics_.text());
    reply.content_type = "text/plain; version=0.0.4; charset=utf-8";
    return reply;
}

HttpReply HttpRoutes::scenes() const {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& scene : scenes_.list()) {
        all.push_back(wire::to_json(scene->summary()));
    }
    return json_reply(200, nlohmann::json{{"scenes", std::move(all)}}.dump());
}

HttpReply HttpRoutes::environments() const {
    nlohmann::json all = nlohmann::json::array();
    for (const Environment::Description& environment : environments_.list()) {
        all.push_back({{"name", environment.name},
                       {"kind", name_from(environment.kind)},
                       {"version", environment.version},
                       {"width", environment.width},
                       {"height", environment.height}});
    }
    return json_reply(200, nlohmann::json{{"environments", std::move(all)}}.dump());
}

HttpReply HttpRoutes::materials() const {
    nlohmann::json all = nlohmann::json::array();
    for (const MaterialLibrary::SharedFamily& family : materials_.list()) {
        all.push_back(wire::to_json(family->description()));
    }
    return json_reply(200, nlohmann::json{{"materials", std::move(all)}}.dump());
}

HttpReply HttpRoutes::picture(std::string_view name, ScenePicture picture) const {
    const std::shared_ptr<const ServedScene> scene = scenes_.find(name);
    if (!scene) {
        return not_found(name, scenes_.expected_in_place_of(name));
    }
    std::optional<std::string> image = read_picture(*scene, picture);
    if (!image) {
        const std::string_view file = kScenePictures.name(picture);
        return not_found(fmt::format("a scene without {}", file),
                         fmt::format("view/{} in its directory", file));
    }
    return image_reply("image/png", std::make_shared<const std::string>(*std::move(image)));
}

HttpReply HttpRoutes::preview(std::string_view name) const {
    const std::shared_ptr<Environment> environment = environments_.find(name);
    if (!environment) {
        return not_found(name, "the name of an environment listed by /api/environments");
    }
    try {
        return image_reply("image/jpeg", environment->preview_jpeg());
    } catch (const light::EnvironmentError& failure) {
        return error_reply(
            500, WireError(ErrorCode::bad_image, "",
                           failure.found().empty() ? std::string(name) : failure.found(),
                           "a readable HDR image"));
    }
}

HttpReply HttpRoutes::file(const HttpRequest& request) const {
    const std::string& path = request.target.path;
    const StaticFile* const found = files_.find(path == "/" ? "/index.html" : path);
    if (found == nullptr) {
        return not_found(path, "a file of the page");
    }
    HttpReply reply{
        .status = 200,
        .content_type = found->content_type,
        .body = found->body,
        .headers = {{"Cache-Control", found->cache_control}, {"ETag", found->entity_tag}}};
    if (request.if_none_match == found->entity_tag) {
        reply.status = 304;
        reply.body = std::make_shared<const std::string>();
    }
    return reply;
}

}  // namespace relume::net
