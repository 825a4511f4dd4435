#include "protocol/transport/quantise.h"

#include "protocol/transport/cpu_clones.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <cmath>

namespace relume::transport {
namespace {

constexpr float kDeadZone = 0.5F;

constexpr std::size_t kChunk = 32;

RELUME_CPU_CLONES bool is_in_dead_zone(const float* values, const float* inverse_steps) {
    std::uint32_t outside = 0;
    for (std::size_t i = 0; i < kChunk; ++i) {
        outside |= std::abs(values[i] * inverse_steps[i]) >= kDeadZone ? 1U : 0U;
    }
    return outside == 0;
}

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
    for (std::size_t begin = 0; begin < values.size(); begin += kChunk) {
        const std::size_t end = std::min(begin + kChunk, values.size());
        if (end - begin == kChunk && is_in_dead_zone(&values[begin], &inverse_steps[begin])) {
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
