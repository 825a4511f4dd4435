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

nlohmann::json list_of(const Url& server, const std::string& kind) {
    const std::string target = "/api/" + kind;
    return json_from_answer(http_get(server, target), "GET " + target).at(kind);
}

std::vector<std::string> names_of(const Url& server, const std::string& kind) {
    std::vector<std::string> names;
    for (const auto& entry : list_of(server, kind)) {
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

std::vector<std::string> materials_of(const Url& server, const std::string& scene) {
    std::vector<std::string> names;
    for (const auto& entry : list_of(server, "scenes")) {
        if (entry.at("name") == scene && entry.contains("materials")) {
            for (const auto& material : entry.at("materials")) {
                names.push_back(material.at("id").get<std::string>());
            }
        }
    }
    return names;
}

std::vector<wire::OfferedMaterial> offered_materials(const Url& server) {
    const std::string target = "/api/materials";
    const HttpAnswer answer = http_get(server, target);
    std::vector<wire::OfferedMaterial> materials;
    if (answer.status == 404) {
        return materials;
    }
    for (const auto& entry : json_from_answer(answer, "GET " + target).at("materials")) {
        materials.push_back(wire::offered_material_from_json(entry, ""));
    }
    return materials;
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
