// Loops over contiguous arrays that every image runs through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

// sums[i] += weight·values[i].
void add_scaled(std::span<const std::int16_t> values, float weight, std::span<float> sums);

// Σ values[i]², summed in runs of float precision; only used where three digits will do.
[[nodiscard]] double squared_norm(std::span<const float> values);

}  // namespace relume::engine
