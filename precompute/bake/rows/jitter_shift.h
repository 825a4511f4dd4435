// Where in the texels of the light the rays of one surface go.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/receiver.h"

#include <array>
#include <cstdint>

namespace relume::bake {

// Moves the jitter of a point's texels, each part in [0, 1). One pair for each place of a
// packet: texels that are neighbours are moved independently of each other.
struct JitterShift {
    std::array<float, kPacketSize> column{};
    std::array<float, kPacketSize> row{};
};

// Of one of a receiver's surfaces, relative to other receivers: spread evenly over any small
// neighbourhood of them, so that what noise is left at shadow edges is fine-grained.
[[nodiscard]] JitterShift jitter_shift(const SequencePlace& place,
                                       std::uint32_t surface,
                                       std::uint64_t seed);

}  // namespace relume::bake
