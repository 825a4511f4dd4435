#include "protocol/transport/quantise.h"

#include "protocol/transport/hash.h"

#include <algorithm>
#include <cmath>

namespace relume::transport {
namespace {

constexpr float kDeadZone = 0.5F;

std::int32_t rounded(float scaled, std::uint64_t receiver, std::uint64_t column) {
    constexpr float kLargest = 1 << 30;
    const float dither = unit_float(mix_bits(mix_bits(column + 1) ^ receiver));
    return static_cast<std::int32_t>(
        std::clamp(std::floor(scaled + dither), -kLargest, kLargest));
}

}  // namespace

void quantise_cell(std::span<const float, kBlockSize> values,
                   float step,
                   std::uint64_t first_receiver,
                   std::uint64_t column,
                   QuantisedCell& quantised) {
    const float scale = 1.0F / step;
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        const float scaled = values[slot] * scale;
        quantised[slot] =
            std::abs(scaled) < kDeadZone ? 0 : rounded(scaled, first_receiver + slot, column);
    }
}

void quantise_row(std::span<const float> values,
                  std::span<const float> inverse_steps,
                  std::uint64_t receiver,
                  std::uint32_t channel,
                  std::uint32_t channels,
                  std::vector<QuantisedValue>& quantised) {
    // Most values are in the dead zone, and a chunk of them is passed in one comparison.
    constexpr std::size_t kChunk = 16;
    for (std::size_t begin = 0; begin < values.size(); begin += kChunk) {
        const std::size_t end = std::min(begin + kChunk, values.size());
        float largest = 0;
        for (std::size_t j = begin; j < end; ++j) {
            largest = std::max(largest, std::abs(values[j] * inverse_steps[j]));
        }
        if (largest < kDeadZone) {
            continue;
        }
        for (std::size_t j = begin; j < end; ++j) {
            const float scaled = values[j] * inverse_steps[j];
            if (std::abs(scaled) < kDeadZone) {
                continue;
            }
            const std::size_t column = j * channels + channel;
            if (const std::int32_t value = rounded(scaled, receiver, column); value != 0) {
                quantised.push_back(
                    {.column = static_cast<std::uint32_t>(column), .value = value});
            }
        }
    }
}

}  // namespace relume::transport
