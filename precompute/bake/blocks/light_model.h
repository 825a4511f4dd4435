// Lights that stand for what people will relight with, to choose quantisation steps and to
// measure what they cost: no map is at hand when a scene is baked.
#pragma once

#include "precompute/bake/blocks/signal_model.h"
#include "protocol/basis/cubemap_projection.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

// Coefficients of natural light fall off as 2^(−kNaturalFalloff·octave). Photographs show an
// exponent of one [Dror04]; a bare sun shows zero; this is what the harder half of eight CC0
// maps shows, those with lamps or a sun in them.
inline constexpr float kNaturalFalloff = 0.25F;

// Colourless lighting coefficients of mean radiance 1.
//
// - Natural: a constant plus noise of equal standard deviation, as far as the basis holds it.
// - Sun: one texel of the upper half of the world holds all the energy.
[[nodiscard]] std::vector<float> natural_light(const basis::CubemapBasis& basis,
                                               std::uint64_t seed);
// How far the coefficients of natural light stray: 0 where its constant has one.
[[nodiscard]] std::vector<float> natural_deviations(const basis::CubemapBasis& basis);
[[nodiscard]] std::vector<float> sun_light(const basis::CubemapProjection& projection,
                                           std::uint64_t seed);

// Steps grow with the octave, and natural light falls with it: step_chooser.h says why.
inline constexpr float kStepGrowth = 0.7F;  // β
[[nodiscard]] SignalModel light_signals(const basis::CubemapProjection& projection);

}  // namespace relume::bake
