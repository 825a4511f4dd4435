// How finely each column is to be quantised, from the rows of a few blocks.
//
// Steps grow with the band, step(band) = c·growth(band), as the coefficients of natural signals
// fall with it; of light growth is 2^(β·octave). Reverse water-filling spreads the expected
// error of the image evenly. c is set so that under natural signals the expected error equals
// that of [Ng03], which spends `bits` bits on the range of each column, receiver by receiver.
// Natural light hardly weighs the fine bands, and a bare sun lives in them: a largest step
// keeps the error of a signal that has the same energy in every column, as a lone lit texel on
// average, at [Ng03]'s too.
#pragma once

#include "precompute/bake/blocks/signal_model.h"
#include "protocol/transport/block_basis.h"
#include "protocol/transport/format.h"
#include "protocol/transport/manifest.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

class StepChooser {
  public:
    // Keeps some columns of every band. `signals` outlives it.
    StepChooser(const SignalModel& signals,
                transport::BlockBasis block_basis,
                std::size_t blocks);

    // The row of a receiver, N values; receivers never set are zero. Thread-safe for different
    // receivers.
    void set_row(std::size_t block, std::uint32_t slot, std::span<const float> row);

    // [N][K]. Transforms the rows to the blocks' basis: called once, when all are set.
    [[nodiscard]] std::vector<float> steps(std::uint32_t bits,
                                           const transport::ColourModel& colour);

  private:
    struct Column {
        std::uint32_t index;
        std::uint32_t band;
        double weight;  // columns it stands for
    };
    struct SquaredErrors {
        double natural = 0;     // under natural light
        double lone_light = 0;  // of one texel lit alone, in the mean over texels
    };
    using Cell = std::array<float, transport::kBlockSize>;

    [[nodiscard]] SquaredErrors column_range_errors(std::uint32_t bits) const;
    // Of steps step(column).
    template <typename Error>
    [[nodiscard]] SquaredErrors sum_over_cells(Error error_of) const;
    template <typename Step>
    [[nodiscard]] SquaredErrors errors(Step step) const;

    const SignalModel& signals_;
    transport::BlockBasis block_basis_;
    std::size_t blocks_;
    std::vector<Column> columns_;
    std::vector<Cell> cells_;  // [columns][blocks]
};

}  // namespace relume::bake
