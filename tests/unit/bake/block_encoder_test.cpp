#include "precompute/bake/block_encoder.h"

#include "protocol/transport/hash.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::bake {
namespace {

TEST(BlockEncoder, RowsGiveTheSameBytesAsCells) {
    constexpr std::uint32_t kColumns = 96;
    constexpr std::uint32_t kChannels = 3;
    constexpr std::uint64_t kFirstReceiver = 7 * transport::kBlockSize;
    const auto value_of = [](std::uint64_t slot, std::uint64_t j, std::uint64_t k) {
        const float u =
            transport::unit_float(transport::mix_bits((slot * kColumns + j) * kChannels + k));
        return std::pow(u, 8.0F) * 400 * (u > 0.9F ? -1.0F : 1.0F);
    };
    std::vector<float> steps(kColumns * kChannels);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        steps[i] = 0.5F + 0.1F * static_cast<float>(i % 7);
    }
    BlockEncoder encoder;
    for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
        for (std::uint32_t k = 0; k < kChannels; ++k) {
            std::vector<float> values;
            std::vector<float> inverse_steps;
            for (std::uint32_t j = 0; j < kColumns; ++j) {
                values.push_back(value_of(slot, j, k));
                inverse_steps.push_back(1.0F / steps[j * kChannels + k]);
            }
            transport::quantise_row(values, inverse_steps, kFirstReceiver + slot, k, kChannels,
                                    encoder.row(slot));
        }
    }
    const transport::EncodedBlock by_rows = encoder.encode(steps.size());

    transport::EncodedBlock by_cells(steps.size());
    for (std::uint32_t i = 0; i < steps.size(); ++i) {
        std::array<float, transport::kBlockSize> values{};
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            values[slot] = value_of(slot, i / kChannels, i % kChannels);
        }
        transport::QuantisedCell cell;
        transport::quantise_cell(values, steps[i], kFirstReceiver, i, cell);
        by_cells.append(cell);
    }
    ASSERT_TRUE(by_rows.complete());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        ASSERT_EQ(by_rows.tag(i), by_cells.tag(i)) << i;
        const auto a = by_rows.cell(i);
        const auto b = by_cells.cell(i);
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << i;
    }
}

TEST(BlockEncoder, ReceiversWithoutLightGiveEmptyCells) {
    const transport::EncodedBlock block = BlockEncoder().encode(10);
    ASSERT_TRUE(block.complete());
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(block.tag(i), transport::CellTag::empty);
    }
}

}  // namespace
}  // namespace relume::bake
