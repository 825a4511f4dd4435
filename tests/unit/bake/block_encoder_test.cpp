#include "precompute/bake/blocks/block_encoder.h"

#include "protocol/transport/block_basis.h"
#include "protocol/transport/hash.h"
#include "protocol/transport/quantise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::bake {
namespace {

constexpr std::uint32_t kColumns = 40;  // not a multiple of what is transposed at once
constexpr std::uint32_t kChannels = 3;

// Smooth over the block, larger in some columns than in others.
float value_of(std::uint32_t slot, std::uint32_t j, std::uint32_t k) {
    const float x = static_cast<float>(slot % transport::kTileSide);
    const float y = static_cast<float>(slot / transport::kTileSide);
    const auto key = std::uint64_t{j} * kChannels + k;
    const float amplitude = std::pow(transport::unit_float(transport::mix_bits(key)), 6.0F);
    return 400 * amplitude * std::sin(0.1F * (x + 2 * y) + static_cast<float>(key));
}

std::vector<float> make_steps() {
    std::vector<float> steps;
    for (std::uint32_t i = 0; i < kColumns * kChannels; ++i) {
        steps.push_back(0.5F + 0.1F * static_cast<float>(i % 7));
    }
    return steps;
}

BlockRows make_rows() {
    BlockRows rows(kColumns, kChannels);
    for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
        for (std::uint32_t k = 0; k < kChannels; ++k) {
            std::vector<float> row;
            for (std::uint32_t j = 0; j < kColumns; ++j) {
                row.push_back(value_of(slot, j, k));
            }
            rows.set(slot, k, row);
        }
    }
    return rows;
}

TEST(BlockEncoder, StoresTheBlocksCoefficientsColumnByColumn) {
    const std::vector<float> steps = make_steps();
    StoredRows stored{.slots = {0, 119, 255}, .rows = {}};
    const transport::EncodedBlock block =
        encode_block(transport::BlockBasis::haar_tile, make_rows(), steps, stored);
    ASSERT_TRUE(block.complete());
    for (std::uint32_t i = 0; i < steps.size(); ++i) {
        const std::uint32_t j = i / kChannels;
        const std::uint32_t k = i % kChannels;
        std::array<float, transport::kBlockSize> values;
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            values[slot] = value_of(slot, j, k);
        }
        transport::block_coefficients_from_receivers(transport::BlockBasis::haar_tile, values);
        transport::QuantisedCell expected;
        transport::quantise_cell(values, steps[i], expected);
        transport::DecodedCell found;
        transport::decode_cell(block.tag(i), block.cell(i).data(), found);
        for (std::size_t s = 0; s < found.size(); ++s) {
            ASSERT_EQ(found[s], static_cast<float>(expected[s])) << i;
            values[s] = found[s] * steps[i];
        }
        // What it says the receivers have become is what a reader will find.
        transport::block_receivers_from_coefficients(transport::BlockBasis::haar_tile, values);
        for (std::size_t s = 0; s < stored.slots.size(); ++s) {
            EXPECT_FLOAT_EQ(stored.rows[s][k * kColumns + j], values[stored.slots[s]]);
        }
    }
}

TEST(BlockEncoder, ReceiversWithoutRowsCostNoCoefficients) {
    BlockRows rows(1, 1);
    const std::array<float, 1> row{6};
    for (std::uint32_t slot = 0; slot < transport::kBlockSize; slot += 3) {
        rows.set(slot, 0, row);
    }
    StoredRows stored;
    const std::array<float, 1> steps{1};
    const transport::EncodedBlock block =
        encode_block(transport::BlockBasis::haar_tile, rows, steps, stored);
    EXPECT_EQ(block.tag(0), transport::CellTag::strips8);
    EXPECT_EQ(transport::cell_nonzeros(block.tag(0), block.cell(0).data()), 1U);
}

TEST(BlockEncoder, BlocksWithoutReceiversGiveEmptyCells) {
    StoredRows stored;
    const std::vector<float> steps(10, 1.0F);
    const transport::EncodedBlock block =
        encode_block(transport::BlockBasis::haar_tile, BlockRows(10, 1), steps, stored);
    ASSERT_TRUE(block.complete());
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(block.tag(i), transport::CellTag::empty);
    }
}

}  // namespace
}  // namespace relume::bake
