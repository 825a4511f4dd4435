// How far the bake's own sampling leaves an image off: the noise of camera positions, of rays
// at shadow edges and of paths.
#pragma once

#include "precompute/bake/parameters.h"
#include "precompute/bake/ray_caster.h"
#include "precompute/scene/camera.h"
#include "protocol/transport/manifest.h"

namespace relume::bake {

// Bakes some pixels of some tiles with two seeds, everything else as in the bake itself, and
// compares what they show under the lights of light_model.h. Half of the mean squared
// difference of two independent rows is the variance of either, so that
//
//     relative L2 = √( Σ (B₁ − B₂)² / 2 ) / √( Σ B₁·B₂ )
//
// over pixels, colours and lights of one kind. What both bakes share is not seen: the blur of
// pooled paths, and what shrinkage takes away. One tile of 64 is looked at, four at least and
// 32 at most; that costs some hundredth parts of the bake. Deterministic, on any number of
// threads.
[[nodiscard]] transport::SamplingError measure_sampling_error(const RayCaster& caster,
                                                              const scene::Camera& camera,
                                                              const BakeParameters& parameters);

}  // namespace relume::bake
