// A signal as the sketch of the transport sees it: S·T·L, band by band.
#pragma once

#include "server/engine/columns/column_table.h"
#include "server/engine/columns/plan.h"
#include "server/engine/columns/significant_columns.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Holds [bands][3][rows] numbers in double precision, so that a light of 10⁵ that comes and
// goes leaves no visible rounding behind. Not thread-safe.
class BandSketches {
  public:
    BandSketches(const ColumnTable& table, const transport::Sketch& sketch);

    // Makes the sketch of these columns from nothing, in one pass that is spread over the
    // caller's arena. The result does not depend on the number of threads.
    void set(const SignificantColumns& significant);
    // Follows a change of the signal: the plan has been carried out on it.
    void apply(const Plan& plan);

    // [3][rows].
    [[nodiscard]] std::span<const double> band(std::uint32_t band) const {
        return std::span(bands_).subspan(band * size_, size_);
    }
    // Numbers of one band, 3·rows.
    [[nodiscard]] std::size_t size() const { return size_; }
    // Number r, below size(), summed over all bands.
    [[nodiscard]] double sum(std::size_t r) const;

    // Of every block, [blocks], not negative: how much its receivers count. 1 at first. A row
    // takes the mean of the blocks of its stratum. Weights change no sum; who adds squares of
    // numbers up multiplies them by the weight of the row.
    void set_block_weights(std::span<const float> weights);
    // Of the row of number r.
    [[nodiscard]] double row_weight(std::size_t r) const {
        return double{row_weights_[r % row_weights_.size()]};
    }

  private:
    const ColumnTable* table_;
    const transport::Sketch* sketch_;
    std::size_t size_;           // 3·rows
    std::vector<float> row_weights_;  // [rows]
    std::vector<double> bands_;  // [bands][3][rows]
    std::vector<float>
        partial_;  // [chunks][3][rows], kept so that the next pass need not allocate
};

// sums[3][rows] += S·T·ΔL of the changes.
void add_sketch(const transport::Sketch& sketch,
                std::span<const ColumnChange> changes,
                std::span<float> sums);
void add_sketch(const transport::Sketch& sketch,
                std::span<const ColumnChange> changes,
                std::span<double> sums);

}  // namespace relume::engine
