#include "protocol/transport/quantise.h"

#include "protocol/transport/hash.h"

#include <algorithm>
#include <cmath>

namespace relume::transport {

void quantise_cell(std::span<const float, kBlockSize> values,
                   float step,
                   std::uint64_t first_receiver,
                   std::uint64_t column,
                   QuantisedCell& quantised) {
    constexpr float kLargest = 1 << 30;
    const float scale = 1.0F / step;
    const std::uint64_t column_key = mix_bits(column + 1);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        const float scaled = values[slot] * scale;
        if (std::abs(scaled) < 0.5F) {
            quantised[slot] = 0;
            continue;
        }
        const float dither = unit_float(mix_bits(column_key ^ (first_receiver + slot)));
        quantised[slot] = static_cast<std::int32_t>(
            std::clamp(std::floor(scaled + dither), -kLargest, kLargest));
    }
}

}  // namespace relume::transport
