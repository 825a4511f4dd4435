// How far the bake's own sampling leaves an image off: the noise of camera positions, of rays
// at shadow edges and of paths, and the bias of what is done against it.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/blocks/cluster_sample.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/receivers.h"
#include "protocol/transport/manifest.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace relume::bake {

// Of a bake that is done, from what it shows (B) of some receivers of some clusters, which were
// drawn where the image is likely to be off, each with a known probability p. They are baked
// once more with another seed (B′), and, where one surface fills the receiver, twice without
// anything that trades bias for noise (U₁, U₂): means over points, without paths of neighbours
// or shrinkage. B − B′ is the noise of two bakes, and of two independent differences
// the product's mean is what they share, whatever their noise:
//
//     e² = Σ (B − B′)²/2p + max(0, Σ (B − U₁)·(B′ − U₂)/p)
//
// over draws, colours and lights of one kind of light_model.h. What is stated is
// √(e² + its standard error) / √(Σ B²), the latter over all receivers: an estimate that is
// rather too large than too small, and is zero only where no receiver that was drawn differs
// between two bakes.
//
// `clusters` hold a sample for every cluster. 48 draws of clusters, chosen by `seed`, are
// looked at, with six draws of receivers in each. Deterministic, on any number of threads.

// Of one draw of a cluster: what its receivers are off by, over their probability in the
// cluster: the two sums above, by kind of signal.
struct DrawnError {
    std::array<double, kSignalKinds> noise{};
    std::array<double, kSignalKinds> bias{};
};

// weight · (a − b)·(c − d), added by kind of signal.
void add_products(double weight,
                  const LitColours& a,
                  const LitColours& b,
                  const LitColours& c,
                  const LitColours& d,
                  std::array<double, kSignalKinds>& sums);

// Bakes receivers that were drawn once more.
using DrawnErrorOf =
    std::function<DrawnError(std::uint32_t cluster, const ClusterSample& sample)>;

[[nodiscard]] transport::SamplingError measure_sampling_error(
    const DrawnErrorOf& error_of, std::uint64_t seed, std::span<const ClusterSample> clusters);

// Of rows of light. `other` are the receivers looked at with another seed.
[[nodiscard]] transport::SamplingError measure_sampling_error(
    const RayCaster& caster,
    const Receivers& receivers,
    const Receivers& other,
    const BakeParameters& parameters,
    std::span<const ClusterSample> clusters);

// The seed of `other`.
[[nodiscard]] std::uint64_t other_seed(const BakeParameters& parameters);

}  // namespace relume::bake
