// The columns of a signal that count in its image. Estimates pass over the others.
#pragma once

#include "server/engine/columns/column_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// The part of the image's norm that may be left out where the error to be estimated is not
// known yet: far below any error that is stated.
inline constexpr double kSurelyNegligible = 2e-6;

// By chunk of a band and colour, in the order of ColumnTable::band_chunks. Not thread-safe.
class SignificantColumns {
  public:
    struct Column {
        std::uint32_t column = 0;
        float amount = 0;
    };

    explicit SignificantColumns(const ColumnTable& table);

    // All columns of signal, planar [3][N], that are not zero.
    void set(std::span<const float> signal);
    // The same without the columns that hardly count. A column counts by its energy in the
    // image, Σ_c (L(c,j)·‖T(c,j)‖)². All columns below a threshold of energy are left out; were
    // they orthogonal, they would together have at most `negligible` of the image's norm. Most
    // columns of a light hardly count: of a sunny sky two thirds at 2·10⁻⁶ and 19 of 20 at
    // 2·10⁻⁴.
    void set_nearly(std::span<const float> signal, double negligible);

    [[nodiscard]] std::span<const Column> of(std::size_t chunk, std::uint32_t colour) const;

  private:
    // Those whose norms_ are above this.
    void take(std::span<const float> signal, float negligible);

    const ColumnTable* table_;
    std::vector<float> norms_;         // L·‖T‖, or L where all count; planar [3][N]
    std::vector<Column> columns_;      // [3][N], those of a chunk from its first place on
    std::vector<std::size_t> counts_;  // [chunks][3]
};

}  // namespace relume::engine
