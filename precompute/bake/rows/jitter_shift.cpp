#include "precompute/bake/rows/jitter_shift.h"

#include "protocol/transport/hash.h"

#include <algorithm>

namespace relume::bake {

JitterShift jitter_shift(const SequencePlace& place,
                         std::uint32_t surface,
                         std::uint64_t seed) {
    const auto fraction = [](double value) {
        const double whole = static_cast<double>(static_cast<std::uint64_t>(value));
        return std::min(static_cast<float>(value - whole), 0x1.fffffep-1F);
    };
    JitterShift shift;
    const std::uint64_t key = transport::mix_bits(transport::mix_bits(seed) + surface);
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        // Each lane walks the sequence from a place and in an order of its own.
        const std::uint64_t bits = transport::mix_bits(key + lane);
        const auto stride = static_cast<double>(1 + 2 * lane);
        shift.column[lane] = fraction(stride * place.along + transport::unit_float(bits));
        shift.row[lane] = fraction(stride * place.across + transport::unit_float(bits << 32U));
    }
    return shift;
}

}  // namespace relume::bake
