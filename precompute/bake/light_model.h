// Lights that stand for what people will relight with, to choose quantisation steps and to
// measure what they cost: no map is at hand when a scene is baked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Colourless lighting coefficients, basis/haar.h, of mean radiance 1.
//
// - Natural: a constant plus noise of equal standard deviation whose wavelet coefficients fall
//   off as 2^−band, as they do in photographs of the real world [Dror04].
// - Sun: one texel of the upper half of the world holds all the energy.
[[nodiscard]] std::vector<float> natural_light(std::uint32_t face_resolution,
                                               std::uint64_t seed);
[[nodiscard]] std::vector<float> sun_light(std::uint32_t face_resolution, std::uint64_t seed);

}  // namespace relume::bake
