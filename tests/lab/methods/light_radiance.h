// Radiance from the coefficients of light.
#pragma once

#include "protocol/basis/cubemap_projection.h"
#include "protocol/light/light_cubemap.h"

#include <span>

namespace relume::lab {

// `coefficients` is planar [3][N] in the projection's basis; `out` is reset to its resolution.
void radiance_from_coefficients(std::span<const float> coefficients,
                                const basis::CubemapProjection& projection,
                                light::LightCubemap& out);

}  // namespace relume::lab
