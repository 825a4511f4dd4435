// Edits given as command-line options, as one patch.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::cli {

struct EditOptions {
    std::string rotate;               // "YAW,PITCH,ROLL" in degrees
    std::vector<std::string> lights;  // "ID:X,Y,Z:RADIUS_DEGREES:R,G,B"
    std::string patch;                // JSON, or @FILE
    std::string method;
    std::string priority;
    std::optional<double> budget_ms;
    std::optional<std::uint32_t> coefficients;
};

// `environment` is a name on the server or empty. Empty object when nothing is asked for. What
// --patch says goes before the other options. Throws ClientError when an option's form is
// wrong; ranges and words are for the server to judge.
[[nodiscard]] nlohmann::json patch_from_options(const EditOptions& options,
                                                const std::string& environment);

}  // namespace relume::cli
