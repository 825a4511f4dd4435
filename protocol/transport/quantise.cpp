#include "protocol/transport/quantise.h"

#include <algorithm>
#include <cmath>

namespace relume::transport {

std::int32_t quantised(float scaled) {
    constexpr float kLargest = 1 << 30;
    return std::abs(scaled) < kDeadZone
               ? 0
               : static_cast<std::int32_t>(std::clamp(std::round(scaled), -kLargest, kLargest));
}

void quantise_cell(std::span<const float, kBlockSize> values, float step, QuantisedCell& cell) {
    const float scale = 1.0F / step;
    for (std::size_t i = 0; i < kBlockSize; ++i) {
        cell[i] = quantised(values[i] * scale);
    }
}

}  // namespace relume::transport
