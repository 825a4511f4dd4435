// Radiance from Haar coefficients.
#pragma once

#include "server/light/light_cubemap.h"

#include <cstdint>
#include <span>

namespace relume::lab {

// `coefficients` is planar [3][6n²]; `out` is reset to resolution n.
void radiance_from_haar(std::span<const float> coefficients,
                        std::uint32_t n,
                        light::LightCubemap& out);

}  // namespace relume::lab
