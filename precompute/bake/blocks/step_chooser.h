// How finely each column is to be quantised, from the rows of a few blocks.
//
// Steps grow with the band, step(band) = c·growth(band), as the coefficients of natural signals
// fall with it; of light growth is 2^(β·octave). Reverse water-filling spreads the expected
// error of the image evenly. c is set so that under natural signals the expected error equals
// that of [Ng03], which spends `bits` bits on the range of each column, receiver by receiver.
// Natural light hardly weighs the fine bands, and a bare sun lives in them: a largest step
// keeps the error of a signal that has the same energy in every column, as a lone lit texel on
// average, at [Ng03]'s too.
//
// Where blocks may be stored in one of several bases, steps are found for each. All bases are
// orthonormal, so that the errors are the same. The first basis is taken unless another one
// takes fewer bytes by kWorthwhile.
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

// About what cells take in a basis, of one channel of the blocks looked at.
struct BytesOfBasis {
    transport::BlockBasis basis = transport::BlockBasis::haar_tile;
    double bytes = 0;
};

struct ChosenSteps {
    transport::BlockBasis basis = transport::BlockBasis::haar_tile;
    std::vector<float> steps;                  // [N][K]
    std::vector<BytesOfBasis> bytes_of_basis;  // empty where there was nothing to choose
};

class StepChooser {
  public:
    // Keeps some columns of every band. `signals` outlives it.
    StepChooser(const SignalModel& signals, std::size_t blocks);

    // The row of a receiver, N values; receivers never set are zero. Thread-safe for different
    // receivers.
    void set_row(std::size_t block, std::uint32_t slot, std::span<const float> row);

    // A part of the bytes that the blocks looked at do not decide by chance.
    static constexpr double kWorthwhile = 0.05;

    // `bases` are one or more. Transforms the rows to the blocks' bases: called once, when all
    // are set.
    [[nodiscard]] ChosenSteps choose(std::uint32_t bits,
                                     const transport::ColourModel& colour,
                                     std::span<const transport::BlockBasis> bases);

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
    // step(band) = min(scale·growth(band), coarsest).
    struct StepRule {
        float scale = 0;
        float coarsest = 0;
    };

    // Slots that were never set get the mean of the others, as encode_block has it.
    void fill_empty_slots();
    // To the basis, as it is stored in it.
    void transform(transport::BlockBasis basis);
    [[nodiscard]] SquaredErrors column_range_errors(std::uint32_t bits) const;
    // Of steps step(column).
    template <typename Error>
    [[nodiscard]] SquaredErrors sum_over_cells(Error error_of) const;
    template <typename Step>
    [[nodiscard]] SquaredErrors errors(Step step) const;
    // Of the cells as they are.
    [[nodiscard]] StepRule rule_for(const SquaredErrors& target) const;
    [[nodiscard]] float step_of_band(const StepRule& rule, std::uint32_t band) const;
    [[nodiscard]] double bytes(const StepRule& rule) const;
    [[nodiscard]] std::vector<float> steps_of_rule(const StepRule& rule,
                                                   const transport::ColourModel& colour) const;

    const SignalModel& signals_;
    std::size_t blocks_;
    std::vector<Column> columns_;
    std::vector<Cell> cells_;                                      // [columns][blocks]
    std::vector<std::array<bool, transport::kBlockSize>> is_set_;  // [blocks]
};

}  // namespace relume::bake
