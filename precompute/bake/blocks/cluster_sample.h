// A few receivers of a cluster, drawn where its image is likely to be off, with what the bake
// shows of them: what the bake's sampling error is estimated from (sampling_error.h).
#pragma once

#include "precompute/bake/blocks/model_signals.h"
#include "precompute/bake/receivers/receivers.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::bake {

// Of one cluster and one kind of light, over receivers, lights and colours.
struct KindSums {
    double energy = 0;  // Σ B²
    double likely = 0;  // Σ of what B is likely to be off by, squared, up to a common factor
};

struct SampledReceiver {
    std::uint64_t receiver = 0;
    double probability = 0;  // of a draw in this cluster to be it
    LitColours baked{};
};

struct ClusterSample {
    static constexpr std::size_t kDraws = 6;

    std::array<KindSums, kSignalKinds> kinds{};
    std::uint32_t receiver_count = 0;  // of those that see anything
    std::uint32_t drawn = 0;           // kDraws, or 0 where none sees anything
    std::array<SampledReceiver, kDraws> draws{};
};

// A receiver that was baked.
struct BakedColours {
    std::uint64_t receiver = 0;
    LitColours colours{};
};

// Noise of sampling shows: where a receiver differs from its neighbours, an edge passes, or the
// rim of a shadow or highlight, or what makes it differ is noise. So a receiver is drawn in
// proportion to the squared differences to its neighbours in the cluster and, far less, to its
// squared brightness, both kinds of light counting alike; one draw of ten takes any. `lit` is
// in ascending order. Depends on nothing but the arguments.
[[nodiscard]] ClusterSample sample_cluster(const Receivers& receivers,
                                           std::span<const BakedColours> lit,
                                           std::uint64_t seed);

}  // namespace relume::bake
