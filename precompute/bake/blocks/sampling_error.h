// How far the bake's own sampling leaves an image off: the noise of camera positions, of rays
// at shadow edges and of paths, and the bias of what is done against it.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/receivers.h"
#include "protocol/transport/manifest.h"

namespace relume::bake {

// Bakes some receivers of some blocks as the bake itself does (B), and twice, with seeds of
// their own, without anything that trades bias for noise (U): every receiver the mean over
// points of it (Receivers::points), no paths of neighbours, no shrinkage. Two independent U
// make the squared error free of their own noise:
//
//     relative L2 = √( Σ (B − U₁)·(B − U₂) ) / √( Σ U₁·U₂ )
//
// over receivers, colours and lights of one kind of light_model.h. One block of 32 is looked
// at, twelve at least and 48 at most, and in it every sixteenth receiver; that costs some
// hundredth parts of the bake. Deterministic, on any number of threads.
[[nodiscard]] transport::SamplingError measure_sampling_error(const RayCaster& caster,
                                                              const Receivers& receivers,
                                                              const BakeParameters& parameters);

}  // namespace relume::bake
