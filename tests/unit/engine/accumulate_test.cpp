#include "server/engine/accumulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace relume::engine {
namespace {

using transport::CellTag;
using transport::kBlockSize;
using transport::kColours;
using transport::QuantisedCell;

// A segment of cells of every encoding, in the bytes of a shard file, beginning at any
// alignment.
struct Segment {
    std::vector<std::uint8_t> bytes;
    std::size_t begin = 0;
    std::uint32_t block_count = 0;

    [[nodiscard]] transport::SegmentView view() const {
        const std::uint8_t* tags = bytes.data() + begin;
        return {.tags = tags, .cells = tags + transport::tag_bytes(block_count)};
    }
};

Segment segment_of(const std::vector<QuantisedCell>& cells, std::size_t misalignment) {
    std::vector<std::uint8_t> packed;
    const auto count = static_cast<std::uint32_t>(cells.size());
    std::vector<std::uint8_t> tags(transport::tag_bytes(count));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto tag = static_cast<unsigned>(transport::append_cell(cells[i], packed));
        tags[i / 2] = static_cast<std::uint8_t>(tags[i / 2] | (tag << (i % 2 * 4)));
    }
    Segment segment{.bytes = std::vector<std::uint8_t>(misalignment),
                    .begin = misalignment,
                    .block_count = count};
    segment.bytes.insert(segment.bytes.end(), tags.begin(), tags.end());
    segment.bytes.insert(segment.bytes.end(), packed.begin(), packed.end());
    return segment;
}

std::vector<QuantisedCell> cells_of_every_kind() {
    std::mt19937 random(3);
    std::vector<QuantisedCell> cells;
    for (const int range : {127, 3000, 1 << 20}) {
        for (const int nonzeros : {0, 1, 7, 40, 100, 255, 256}) {
            QuantisedCell cell{};
            std::uniform_int_distribution<int> value(1, range);
            std::fill_n(cell.begin(), nonzeros, 0);
            for (int i = 0; i < nonzeros; ++i) {
                cell[static_cast<std::size_t>(i)] = i % 2 == 0 ? value(random) : -value(random);
            }
            std::shuffle(cell.begin(), cell.end(), random);
            cells.push_back(cell);
        }
    }
    return cells;
}

TEST(Accumulate, AddsWhatTheCellsHoldToTheLastBit) {
    const auto cells = cells_of_every_kind();
    const ColourWeights weights{0.1F, -2.5F, 3e-5F};
    for (std::size_t misalignment = 0; misalignment < 5; ++misalignment) {
        const Segment segment = segment_of(cells, misalignment);
        std::vector<float> sums(cells.size() * kColours * kBlockSize, 0.75F);
        accumulate_segment(segment.view(), segment.block_count, weights, sums.data());
        for (std::size_t b = 0; b < cells.size(); ++b) {
            for (std::size_t c = 0; c < kColours; ++c) {
                for (std::size_t i = 0; i < kBlockSize; ++i) {
                    const float expected = 0.75F + weights[c] * static_cast<float>(cells[b][i]);
                    ASSERT_EQ(sums[(b * kColours + c) * kBlockSize + i], expected)
                        << "block " << b << " slot " << i;
                }
            }
        }
    }
}

TEST(Accumulate, LeavesTheBlocksOfOtherShardsAlone) {
    const Segment segment = segment_of({QuantisedCell{1, 2, 3}}, 0);
    std::vector<float> sums(2 * kColours * kBlockSize);
    accumulate_segment(segment.view(), segment.block_count, {1, 1, 1}, sums.data());
    EXPECT_TRUE(std::all_of(sums.begin() + kColours * kBlockSize, sums.end(),
                            [](float value) { return value == 0; }));
}

}  // namespace
}  // namespace relume::engine
