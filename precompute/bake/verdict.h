// What a finished bake comes to, in words: what it is good for, what is missing from it, how
// far off it is, and what to do next.
#pragma once

#include "precompute/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace relume::bake {

// Some lines for a terminal. `description` is describe()'s of the directory; what a scene's
// file says of itself is quoted without control characters.
[[nodiscard]] std::string verdict(const scene::ImportReport& report,
                                  const nlohmann::json& description,
                                  const std::filesystem::path& directory);

// A fraction as people read it: "0.8 %", "0.035 %", "12 %".
[[nodiscard]] std::string per_cent(double fraction);

}  // namespace relume::bake
