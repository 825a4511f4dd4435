// Materials by the names that people call them by.
#pragma once

#include "precompute/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace relume::bake {

// Index into the scene's materials of the first with this name.
[[nodiscard]] std::optional<std::uint32_t> find_material(const scene::Scene& scene,
                                                         std::string_view name);

// A message for a name that no material has; `option` is what asked for it, and what resembles
// the name is named.
[[nodiscard]] std::string no_such_material(const std::string& option,
                                           const std::string& name,
                                           const scene::Scene& scene);

}  // namespace relume::bake
