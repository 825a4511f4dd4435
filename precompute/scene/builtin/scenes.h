// The built-in scenes, one file each. Metres, +Y up, the floor at y = 0.
#pragma once

#include "precompute/scene/scene.h"

namespace relume::scene {

[[nodiscard]] Scene build_table();
[[nodiscard]] Scene build_box();
[[nodiscard]] Scene build_thin();
[[nodiscard]] Scene build_street();
[[nodiscard]] Scene build_mesh100k();
[[nodiscard]] Scene build_plane();
[[nodiscard]] Scene build_bowl();
[[nodiscard]] Scene build_earrings();

}  // namespace relume::scene
