// Lights that stand for what people will relight with, to choose quantisation steps and to
// measure what they cost: no map is at hand when a scene is baked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Coefficients of natural light fall off as 2^(−kNaturalFalloff·band): between the exponent one
// of photographs [Dror04] and the zero of a bare sun, and the mean found in eight CC0 maps.
inline constexpr float kNaturalFalloff = 0.5F;

// Colourless lighting coefficients, basis/haar.h, of mean radiance 1.
//
// - Natural: a constant plus noise of equal standard deviation.
// - Sun: one texel of the upper half of the world holds all the energy.
[[nodiscard]] std::vector<float> natural_light(std::uint32_t face_resolution,
                                               std::uint64_t seed);
[[nodiscard]] std::vector<float> sun_light(std::uint32_t face_resolution, std::uint64_t seed);

}  // namespace relume::bake
