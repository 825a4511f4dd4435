#include "client/cli/server_names.h"

#include "client/cli/client_error.h"
#include "client/cli/http_client.h"
#include "protocol/base/text/near_names.h"
#include "protocol/base/text/strict_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace relume::cli {
namespace {

std::vector<std::string> names_of(const Url& server, const std::string& kind) {
    const std::string target = "/api/" + kind;
    const nlohmann::json answer = json_from_answer(http_get(server, target), "GET " + target);
    std::vector<std::string> names;
    for (const auto& entry : answer.at(kind)) {
        names.push_back(entry.at("name").get<std::string>());
    }
    return names;
}

}  // namespace

std::vector<std::string> scenes_of(const Url& server) {
    return names_of(server, "scenes");
}

std::vector<std::string> environments_of(const Url& server) {
    return names_of(server, "environments");
}

void require_scene(const Url& server, const std::string& scene) {
    const std::vector<std::string> known = scenes_of(server);
    if (std::find(known.begin(), known.end(), scene) == known.end()) {
        throw ClientError(fmt::format("scene {}: the server has none of that name, expected {}",
                                      text::quote(scene),
                                      text::expected_name(scene, known, "scenes")));
    }
}

}  // namespace relume::cli
