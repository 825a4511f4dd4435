#include "server/engine/operators/strip_matrix.h"

#include "protocol/transport/cell_strips.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace relume::engine {
namespace {

using transport::CellTag;
using transport::DecodedCell;
using transport::kBlockSize;
using transport::kColours;
using transport::QuantisedCell;

// Σ 256^part·values, put back strip by strip.
class Reassembled {
  public:
    void add(std::size_t part, std::size_t strip, const auto& values) {
        for (std::size_t i = 0; i < transport::kStripSlots; ++i) {
            cell_[strip * transport::kStripSlots + i] +=
                std::pow(256.0F, static_cast<float>(part)) * static_cast<float>(values[i]);
        }
    }
    [[nodiscard]] const DecodedCell& cell() const { return cell_; }

  private:
    DecodedCell cell_{};
};

// The strips of a cell add up to the cell, in every encoding that fits it, and none is empty.
TEST(CellStrips, AddUpToTheCell) {
    std::mt19937 random(11);
    for (const int range : {1, 127, 32767, 1 << 20}) {
        for (const int nonzeros : {0, 1, 9, 256}) {
            QuantisedCell cell{};
            for (int i = 0; i < nonzeros; ++i) {
                cell[random() % kBlockSize] =
                    std::uniform_int_distribution(-range, range)(random);
            }
            for (std::size_t tag = 0; tag < transport::kCellTagCount; ++tag) {
                const auto as = static_cast<CellTag>(tag);
                if (!transport::CellShape::of(cell).fits(as)) {
                    continue;
                }
                std::vector<std::uint8_t> bytes;
                transport::append_cell_as(as, cell, bytes);
                Reassembled sum;
                transport::for_each_strip(
                    as, bytes.data(),
                    [&](std::size_t part, std::size_t strip, const auto& values) {
                        sum.add(part, strip, values);
                        EXPECT_TRUE(std::any_of(values.begin(), values.end(),
                                                [](auto value) { return value != 0; }));
                    });
                DecodedCell expected;
                transport::decode_cell(as, bytes.data(), expected);
                EXPECT_EQ(sum.cell(), expected) << transport::kCellTagNames[tag];
            }
        }
    }
}

// Against the plainest product in double precision, with cells of all encodings.
TEST(StripMatrix, MultipliesToTheDenseProduct) {
    for (const std::uint32_t channels : {1U, 3U}) {
        const TinyScene tiny({.channels = channels, .seed = 3});
        const StripMatrix& strips = tiny.scene()->stored_operator().strips();
        const std::vector<float> lighting = test::random_lighting(8, 4);
        TransportOperator::Weights weights;
        strips.set_weights(tiny.transport(), lighting, weights);
        std::vector<float> sums(tiny.scene()->stored_operator().sum_count());
        for (std::uint32_t block = 0; block < strips.block_count(); ++block) {
            for (std::uint32_t band = 0; band < tiny.scene()->columns().band_count(); ++band) {
                const StripMatrix::Member member{.weights = &weights,
                                                 .sums = &sums[block * kColours * kBlockSize]};
                strips.multiply(block, band, {&member, 1});
            }
        }
        EXPECT_LT(test::relative_l2(sums, test::dense_product(tiny.transport(), lighting)),
                  1e-6);
    }
}

// A band that a block is said to have nothing in adds nothing to it.
TEST(StripMatrix, KnowsTheBandsOfABlock) {
    const TinyScene tiny({.seed = 5, .density = 0.02F});
    const StripMatrix& strips = tiny.scene()->stored_operator().strips();
    const std::vector<float> lighting = test::random_lighting(8, 4);
    TransportOperator::Weights weights;
    strips.set_weights(tiny.transport(), lighting, weights);
    std::size_t empty = 0;
    for (std::uint32_t block = 0; block < strips.block_count(); ++block) {
        for (std::uint32_t band = 0; band < tiny.scene()->columns().band_count(); ++band) {
            std::vector<float> sums(kColours * kBlockSize);
            const StripMatrix::Member member{.weights = &weights, .sums = sums.data()};
            strips.multiply(block, band, {&member, 1});
            const bool is_black =
                std::all_of(sums.begin(), sums.end(), [](float sum) { return sum == 0; });
            EXPECT_EQ((strips.bands_of_block(block) >> band & 1U) == 0, is_black);
            empty += is_black ? 1U : 0U;
        }
    }
    EXPECT_GT(empty, 0U);
}

}  // namespace
}  // namespace relume::engine
