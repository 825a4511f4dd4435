// How far the light shown is from the light asked for.
#pragma once

#include "server/light/light_cubemap.h"

namespace relume::lab {

// Σ ω |L − L̃| / Σ ω |L| over texels and colours, ω the texel's solid angle: the L1 norm over
// the sphere, the same for every basis. 0 where both are black, 1 where only L is.
[[nodiscard]] double lighting_error_l1(const light::LightCubemap& shown,
                                       const light::LightCubemap& target);

}  // namespace relume::lab
