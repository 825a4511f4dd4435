// Random combinations of a transport's rows, by which errors are estimated.
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::transport {

// S·T, a random matrix S times the transport: `rows()` numbers for each column and colour.
class Sketch {
  public:
    Sketch() = default;
    // Scales [N][3], values [N][3][rows].
    Sketch(std::uint32_t rows,
           std::span<const float> scales,
           std::span<const std::int8_t> values)
        : rows_(rows), scales_(scales), values_(values) {}

    [[nodiscard]] std::uint32_t rows() const { return rows_; }
    // Integers; times scale(column, colour) they are the numbers.
    [[nodiscard]] std::span<const std::int8_t> values(std::size_t column,
                                                      std::uint32_t colour) const {
        return values_.subspan(first_value(column, colour), rows_);
    }
    // All of them, [N][3][rows], and where those of a column and colour begin.
    [[nodiscard]] std::span<const std::int8_t> table() const { return values_; }
    [[nodiscard]] std::size_t first_value(std::size_t column, std::uint32_t colour) const {
        return (column * kColours + colour) * rows_;
    }
    [[nodiscard]] float scale(std::size_t column, std::uint32_t colour) const {
        return scales_[column * kColours + colour];
    }

  private:
    std::uint32_t rows_ = 0;
    std::span<const float> scales_;
    std::span<const std::int8_t> values_;
};

}  // namespace relume::transport
