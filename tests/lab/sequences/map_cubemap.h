// A map as the cubemap that a scene is lit by.
#pragma once

#include "precompute/bake/relight.h"

#include <cstdint>
#include <string>

namespace relume::lab {

// As it lights a scene, not turned; throws as load_environment.
[[nodiscard]] bake::CubemapLight cubemap_of_map(const std::string& name,
                                                std::uint32_t face_resolution);

}  // namespace relume::lab
