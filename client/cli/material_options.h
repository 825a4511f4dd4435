// Edits of materials given as command-line options.
#pragma once

#include "client/cli/url.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::cli {

struct MaterialOptions {
    std::vector<std::string> curves = {};    // "MATERIAL=JSON" or "MATERIAL=@FILE"
    std::vector<std::string> diffuses = {};  // "MATERIAL=R,G,B"
    std::vector<std::string> tints = {};     // the same
};

// The section `materials` of a patch; an empty object when nothing is asked for. The JSON of a
// curve is its samples, 256 numbers or 256 arrays [r, g, b], or an object that a patch may have
// for a material, such as {"shape": "ggx", "roughness": 0.1}. Throws program::UsageError for an
// option whose form is wrong, and ClientError for a file that cannot be read and JSON that is
// neither. Ranges and words are for the server to judge.
[[nodiscard]] nlohmann::json materials_from_options(const MaterialOptions& options);

// Throws ClientError unless every key of `materials` is a material of the scene, which the
// server has; it names those that resemble the one that is not.
void require_materials(const Url& server,
                       const std::string& scene,
                       const nlohmann::json& materials);

}  // namespace relume::cli
