// Edits given as command-line options, as one patch.
#pragma once

#include "client/cli/material_options.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::cli {

struct EditOptions {
    std::string rotate;               // "YAW,PITCH,ROLL" in degrees
    std::vector<std::string> lights;  // "ID:X,Y,Z:RADIUS_DEGREES:R,G,B"
    std::string eye;                  // "X,Y,Z" in the world
    std::string look_at;              // the same
    std::string up;                   // the same, a direction
    std::optional<double> fov_degrees;
    MaterialOptions materials;
    std::vector<std::string> finishes;  // "PART=MATERIAL[@NUMBER][:R,G,B …]"
    std::string size;                   // "WIDTHxHEIGHT" in pixels
    std::string patch;                  // JSON, or @FILE; applied first
    std::string method;
    std::string priority;
    std::optional<double> budget_ms;
    std::optional<std::uint32_t> coefficients;
};

// A JSON merge patch, or what the file of `@FILE` holds, as the page's exported lighting; an
// empty object for an empty text. Throws ClientError with line and column of a fault.
[[nodiscard]] nlohmann::json patch_from_text(const std::string& text_or_file);

// `environment` is a name on the server or empty. Empty object when nothing is asked for. The
// other options are applied over what --patch says. Throws ClientError for the patch and the
// curves and program::UsageError for an option whose form is wrong; ranges and words are for
// the server to judge.
[[nodiscard]] nlohmann::json patch_from_options(const EditOptions& options,
                                                const std::string& environment);

}  // namespace relume::cli
