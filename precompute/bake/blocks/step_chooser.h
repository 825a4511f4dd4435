// How finely each column is to be quantised, from the rows of a few blocks.
//
// Steps grow with the band, step(band) = c·2^(β·octave), as the coefficients of natural light
// fall with it: reverse water-filling spreads the expected error of the image evenly. c is set
// so that under natural light the expected error equals that of [Ng03], which spends `bits`
// bits on the range of each column, receiver by receiver. Natural light hardly weighs the fine
// bands, and a bare sun lives in them: a largest step keeps the error of a lone lit texel at
// [Ng03]'s too.
#pragma once

#include "protocol/basis/cubemap_basis.h"
#include "protocol/transport/format.h"
#include "protocol/transport/manifest.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

inline constexpr float kStepGrowth = 0.7F;  // β

class StepChooser {
  public:
    // Keeps some columns of every band.
    StepChooser(const basis::CubemapBasis& basis,
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

    basis::CubemapBasis basis_;
    transport::BlockBasis block_basis_;
    std::size_t blocks_;
    std::vector<Column> columns_;
    std::vector<Cell> cells_;  // [columns][blocks]
};

}  // namespace relume::bake
