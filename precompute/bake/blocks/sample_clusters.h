// A few clusters that stand for all of them.
#pragma once

#include "precompute/bake/receivers/receivers.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

// How many of the clusters: one of `every`, at least `least`, at most `most`.
struct SampleCount {
    std::uint32_t every = 16;
    std::size_t least = 1;
    std::size_t most = 16;
};

// Clusters spread evenly over those whose middle sees the scene, over all others where there
// are none; fewer than `least` where there are fewer. Deterministic.
[[nodiscard]] std::vector<std::uint32_t> sample_clusters(const Receivers& receivers,
                                                         const SampleCount& count,
                                                         std::uint64_t seed);

}  // namespace relume::bake
