// Loops over contiguous arrays that every image runs through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

// A row of values somewhere in a table, and what it is multiplied with.
struct WeightedRow {
    std::size_t first = 0;  // index of its first value
    float weight = 0;
};

// sums[i] += Σ_rows weight·table[first + i], each sum in the order of the rows, every product
// added without rounding in between: the same bits on every instruction set.
void add_rows(std::span<const std::int8_t> table,
              std::span<const WeightedRow> rows,
              std::span<float> sums);
void add_rows(std::span<const std::int8_t> table,
              std::span<const WeightedRow> rows,
              std::span<double> sums);

// Σ values[i]², summed in runs of float precision; only used where three digits will do.
[[nodiscard]] double squared_norm(std::span<const float> values);

}  // namespace relume::engine
