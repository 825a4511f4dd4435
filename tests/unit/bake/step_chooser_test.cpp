// Steps of quantisation, and the basis in which blocks are shortest.
#include "precompute/bake/blocks/step_chooser.h"

#include "precompute/bake/blocks/block_encoder.h"
#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/light_model.h"
#include "protocol/transport/hash.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

namespace relume::bake {
namespace {

using transport::BlockBasis;
using transport::kBlockSize;

constexpr std::array kBoth{BlockBasis::haar_line, BlockBasis::identity};
constexpr std::uint32_t kFace = 4;  // so few columns that none is left out
constexpr std::uint32_t kBits = 8;
constexpr std::size_t kBlocks = 2;

class StepChooserTest : public testing::Test {
  protected:
    using Value = std::function<float(std::size_t block, std::uint32_t slot, std::size_t j)>;

    [[nodiscard]] std::vector<float> row(const Value& value,
                                         std::size_t block,
                                         std::uint32_t slot) const {
        std::vector<float> row;
        for (std::size_t j = 0; j < columns(); ++j) {
            row.push_back(value(block, slot, j));
        }
        return row;
    }
    // Of the first `present` slots.
    [[nodiscard]] ChosenSteps chosen(const Value& value,
                                     std::span<const BlockBasis> bases,
                                     std::uint32_t present = kBlockSize) const {
        StepChooser chooser(signals_, kBlocks);
        for (std::size_t block = 0; block < kBlocks; ++block) {
            for (std::uint32_t slot = 0; slot < present; ++slot) {
                chooser.set_row(block, slot, row(value, block, slot));
            }
        }
        return chooser.choose(kBits, grey_model(), bases);
    }
    // Bytes of all cells, and the squared error of what they store.
    struct Stored {
        std::size_t bytes = 0;
        double squared_error = 0;
    };
    [[nodiscard]] Stored stored(const Value& value,
                                const ChosenSteps& steps,
                                std::uint32_t present = kBlockSize) const {
        Stored found;
        for (std::size_t block = 0; block < kBlocks; ++block) {
            BlockRows rows(columns(), 1);
            StoredRows read;
            for (std::uint32_t slot = 0; slot < present; ++slot) {
                rows.set(slot, 0, row(value, block, slot));
                read.slots.push_back(slot);
            }
            const auto encoded = encode_block(steps.basis, rows, steps.steps, read);
            for (std::size_t j = 0; j < columns(); ++j) {
                found.bytes += encoded.cell(j).size();
                for (std::uint32_t slot = 0; slot < present; ++slot) {
                    found.squared_error +=
                        std::pow(read.rows[slot][j] - value(block, slot, j), 2);
                }
            }
        }
        return found;
    }
    [[nodiscard]] std::size_t columns() const {
        return projection_->basis().coefficient_count();
    }

  private:
    std::shared_ptr<const basis::CubemapProjection> projection_ =
        basis::CubemapProjection::onto(basis::CubemapBasis::haar(kFace));
    SignalModel signals_ = light_signals(*projection_);
};

float noise(std::size_t a, std::size_t b, std::size_t c) {
    return transport::unit_float(transport::mix_bits(a * 1'000'003 + b * 1009 + c)) - 0.5F;
}

// Neighbours answer alike.
float smooth(std::size_t block, std::uint32_t slot, std::size_t j) {
    const auto at = static_cast<float>(slot) / kBlockSize;
    return std::sin(2 * at + static_cast<float>(block + j));
}

// One vertex in eight answers, each in its own way.
float sparse(std::size_t block, std::uint32_t slot, std::size_t j) {
    return noise(block + 7, slot, j) > 0.375F ? noise(block, slot, j) : 0;
}

TEST_F(StepChooserTest, TakesTheBasisInWhichBlocksAreShortest) {
    EXPECT_EQ(chosen(smooth, kBoth).basis, BlockBasis::haar_line);
    EXPECT_EQ(chosen(sparse, kBoth).basis, BlockBasis::identity);
}

TEST_F(StepChooserTest, HasNothingToChooseOfOneBasis) {
    const ChosenSteps alone = chosen(sparse, std::array{BlockBasis::haar_line});
    EXPECT_EQ(alone.basis, BlockBasis::haar_line);
    EXPECT_TRUE(alone.bytes_of_basis.empty());
    // A full block's steps are the same, whatever else there is.
    EXPECT_EQ(alone.steps,
              chosen(sparse, std::array{BlockBasis::haar_line, BlockBasis::haar_line}).steps);
}

// Also of clusters that are not full.
TEST_F(StepChooserTest, CountsTheBytesThatAreWrittenForTheSameError) {
    for (const Value& value : {Value(smooth), Value(sparse)}) {
        for (const std::uint32_t present : {kBlockSize, std::uint32_t{90}}) {
            std::array<double, 2> errors{};
            for (std::size_t i = 0; i < kBoth.size(); ++i) {
                const ChosenSteps steps =
                    chosen(value, std::array{kBoth[i], kBoth[i]}, present);
                const Stored found = stored(value, steps, present);
                const auto written = static_cast<double>(found.bytes);
                EXPECT_NEAR(steps.bytes_of_basis.front().bytes, written, 0.01 * written);
                errors[i] = std::sqrt(found.squared_error);
            }
            EXPECT_NEAR(errors[0], errors[1], 0.2 * errors[0]) << present;
        }
    }
}

// Of a cluster that is not full, slots without a vertex cost nothing.
TEST(BlockEncoder, EmptySlotsOfValuesThemselvesAreZero) {
    BlockRows rows(3, 1);
    rows.set(5, 0, std::vector<float>{1, 2, 3});
    const std::vector<float> steps(3, 0.1F);
    StoredRows stored{.slots = {4, 5}, .rows = {}};
    const auto block = encode_block(BlockBasis::identity, rows, steps, stored);
    for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_LT(block.cell(j).size(), 40U);
        EXPECT_EQ(stored.rows[0][j], 0);
        EXPECT_NEAR(stored.rows[1][j], static_cast<float>(j + 1), 0.1F);
    }
}

}  // namespace
}  // namespace relume::bake
