// Random combinations of a transport's rows, by which errors are estimated.
#pragma once

#include "protocol/transport/format.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::transport {

// Which rows of a sketch are made of which blocks. In one stratum every row is made of all
// blocks. In several, neighbouring blocks have rows of their own, so that whoever reads the
// sketch can weigh one part of the receivers more than another.
struct SketchStrata {
    static constexpr std::uint32_t kRowsOfStratum = 8;  // of the last one up to twice as many

    std::uint32_t rows = 0;
    std::uint32_t blocks = 0;
    std::uint32_t strata = 1;

    // As many as the rows allow.
    [[nodiscard]] static constexpr SketchStrata several(std::uint32_t rows,
                                                        std::uint32_t blocks) {
        return {rows, blocks, std::max(1U, std::min(rows / kRowsOfStratum, blocks))};
    }
    [[nodiscard]] constexpr std::uint32_t stratum_of_block(std::uint32_t block) const {
        return static_cast<std::uint32_t>(std::uint64_t{block} * strata / blocks);
    }
    [[nodiscard]] constexpr std::uint32_t first_row(std::uint32_t stratum) const {
        return stratum * (rows / strata);
    }
    [[nodiscard]] constexpr std::uint32_t row_count(std::uint32_t stratum) const {
        return (stratum + 1 == strata ? rows : first_row(stratum + 1)) - first_row(stratum);
    }
};

// S·T, a random matrix S times the transport: `rows()` numbers for each column and colour.
class Sketch {
  public:
    Sketch() = default;
    // Scales [N][3], values [N][3][rows].
    Sketch(const SketchStrata& strata,
           std::span<const float> scales,
           std::span<const std::int8_t> values)
        : strata_(strata), scales_(scales), values_(values) {}

    [[nodiscard]] std::uint32_t rows() const { return strata_.rows; }
    [[nodiscard]] const SketchStrata& strata() const { return strata_; }
    // Integers; times scale(column, colour) they are the numbers.
    [[nodiscard]] std::span<const std::int8_t> values(std::size_t column,
                                                      std::uint32_t colour) const {
        return values_.subspan(first_value(column, colour), rows());
    }
    // All of them, [N][3][rows], and where those of a column and colour begin.
    [[nodiscard]] std::span<const std::int8_t> table() const { return values_; }
    [[nodiscard]] std::size_t first_value(std::size_t column, std::uint32_t colour) const {
        return (column * kColours + colour) * rows();
    }
    [[nodiscard]] float scale(std::size_t column, std::uint32_t colour) const {
        return scales_[column * kColours + colour];
    }

  private:
    SketchStrata strata_;
    std::span<const float> scales_;
    std::span<const std::int8_t> values_;
};

}  // namespace relume::transport
