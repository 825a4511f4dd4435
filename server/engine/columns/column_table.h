// The columns of an operator as choosing sees them: band, cost, energy and sketch of each.
#pragma once

#include "protocol/basis/bands.h"
#include "protocol/relighting/strategy.h"
#include "protocol/transport/sketch.h"
#include "server/engine/columns/band_chunk.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Knows nothing of light, of pixels or of files. Immutable; safe to share between threads. It
// keeps the spans that it is made of, and what they point to must outlive it.
class ColumnTable {
  public:
    // Of N columns.
    struct Columns {
        basis::Bands bands;                    // of the signal's basis
        std::span<const float> energies;       // [N][3], Σ over receivers of T(p,c,j)²
        std::span<const std::uint32_t> bytes;  // [N], read to add the column to sums
        // Two sketches of independent rows: by one the engine chooses, by the other it states
        // its error. An estimate that has been minimised over is biased.
        transport::Sketch stating;
        transport::Sketch choosing;
    };
    // Throws std::invalid_argument where a count is not that of the bands' coefficients, or
    // there are more than basis::kMaxBands bands.
    explicit ColumnTable(Columns columns);

    // N.
    [[nodiscard]] std::size_t count() const { return bands_.coefficient_count(); }
    [[nodiscard]] std::uint32_t band_count() const { return bands_.band_count(); }
    // All bands, a bit each.
    [[nodiscard]] std::uint32_t all_bands() const {
        return (std::uint32_t{1} << band_count()) - 1;
    }
    // Band of every column, [N].
    [[nodiscard]] std::span<const std::uint8_t> bands() const { return bands_.of_coefficient; }

    // All columns, ordered by band and then index: the order in which sums are made, [N].
    [[nodiscard]] std::span<const std::uint32_t> by_band() const { return by_band_; }
    // Those of one band, by index.
    [[nodiscard]] std::span<const std::uint32_t> of_band(std::uint32_t band) const {
        return std::span(by_band_).subspan(band_begins_[band],
                                           band_begins_[band + 1] - band_begins_[band]);
    }
    // Every place in `by_band`, 0 … N−1.
    [[nodiscard]] std::span<const std::uint32_t> places() const { return places_; }
    // The same places in pieces of one band and at most 1024 columns, in order. Loops over the
    // signal are parallel over these pieces, so that their sums do not depend on the number of
    // threads.
    [[nodiscard]] std::span<const BandChunk> band_chunks() const { return band_chunks_; }

    // Bytes read to add a column to sums, and to add every column.
    [[nodiscard]] std::uint32_t bytes(std::size_t column) const { return bytes_[column]; }
    [[nodiscard]] std::uint64_t total_bytes() const { return total_bytes_; }

    [[nodiscard]] const transport::Sketch& stating_sketch() const { return stating_; }
    [[nodiscard]] const transport::Sketch& choosing_sketch() const { return choosing_; }

    // What a coefficient's change is multiplied with, per colour, to rank it: [3][N], planar.
    //   none       1                                             [Ng03 §4.1, unweighted]
    //   area       2^−octave of the band: a wavelet's amplitude·area [Ng03 §4.1,
    //              area-weighted]; the inverse of a tolerance for spherical harmonics
    //   transport  ‖T_j‖ of the colour                    [Ng03 §4.1, transport-weighted]
    //   benefit    ‖T_j‖ / √(bytes of the column): squared, what the sums gain per byte read
    [[nodiscard]] std::span<const float> weights(relighting::Priority priority) const {
        return weights_[static_cast<std::size_t>(priority)];
    }

  private:
    void order_by_band();
    void make_weights(std::span<const float> energies);

    basis::Bands bands_;
    std::span<const std::uint32_t> bytes_;
    std::uint64_t total_bytes_ = 0;
    transport::Sketch stating_;
    transport::Sketch choosing_;
    std::vector<std::uint32_t> by_band_;
    std::vector<std::size_t> band_begins_;  // [bands + 1], places in by_band_
    std::vector<std::uint32_t> places_;
    std::vector<BandChunk> band_chunks_;
    std::array<std::vector<float>, relighting::kPriorityCount> weights_;
};

}  // namespace relume::engine
