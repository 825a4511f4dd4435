#include "server/engine/kernels/accumulate.h"

#include "protocol/transport/cell_cost.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
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
        return {.tags = tags,
                .cells = tags + transport::tag_bytes(block_count),
                .end = bytes.data() + bytes.size() - transport::kShardTailBytes};
    }
};

// Of all encodings that fit the cell one after the other.
CellTag append_in_some_encoding(const QuantisedCell& cell,
                                std::size_t number,
                                std::vector<std::uint8_t>& bytes) {
    const auto shape = transport::CellShape::of(cell);
    for (std::size_t i = number;; ++i) {
        const auto tag = static_cast<CellTag>(i % transport::kCellTagCount);
        if (shape.fits(tag)) {
            transport::append_cell_as(tag, cell, bytes);
            return tag;
        }
    }
}

Segment segment_of(const std::vector<QuantisedCell>& cells, std::size_t misalignment) {
    std::vector<std::uint8_t> packed;
    const auto count = static_cast<std::uint32_t>(cells.size());
    std::vector<std::uint8_t> tags(transport::tag_bytes(count));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto tag = static_cast<unsigned>(append_in_some_encoding(cells[i], i, packed));
        tags[i / 2] = static_cast<std::uint8_t>(tags[i / 2] | (tag << (i % 2 * 4)));
    }
    Segment segment{.bytes = std::vector<std::uint8_t>(misalignment),
                    .begin = misalignment,
                    .block_count = count};
    segment.bytes.insert(segment.bytes.end(), tags.begin(), tags.end());
    segment.bytes.insert(segment.bytes.end(), packed.begin(), packed.end());
    segment.bytes.resize(segment.bytes.size() + transport::kShardTailBytes);
    return segment;
}

// Floats in the widest vector, of 512 bits.
constexpr std::size_t kMostLanes = 16;

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

std::vector<WeightedSegment> weighted(const std::vector<Segment>& segments) {
    std::vector<WeightedSegment> list;
    float weight = 0.1F;
    for (const Segment& segment : segments) {
        list.push_back({segment.view(), {weight, -3 * weight, weight * weight}});
        weight *= std::abs(weight) < 1000 ? -1.7F : 1e-4F;
    }
    return list;
}

TEST(Accumulate, ScalarAddsWhatTheCellsHold) {
    const auto cells = cells_of_every_kind();
    const std::vector<Segment> segments{segment_of(cells, 0)};
    const auto list = weighted(segments);
    std::vector<float> sums(cells.size() * kColours * kBlockSize, 0.75F);
    accumulate_segments_scalar(list, segments[0].block_count, {.sums = sums.data()});
    for (std::size_t b = 0; b < cells.size(); ++b) {
        for (std::size_t c = 0; c < kColours; ++c) {
            for (std::size_t i = 0; i < kBlockSize; ++i) {
                const float expected =
                    0.75F + list[0].weights[c] * static_cast<float>(cells[b][i]);
                // A split value is two products.
                ASSERT_FLOAT_EQ(sums[(b * kColours + c) * kBlockSize + i], expected);
            }
        }
    }
}

// Every instruction set this processor has gives the bits of the specification, for groups of
// every size, cells of every kind next to each other, at every alignment.
TEST(Accumulate, EveryTargetGivesTheBitsOfTheScalar) {
    std::mt19937 random(5);
    for (const std::size_t count :
         {1UL, 2UL, 3UL, 7UL, kMaxGroupSegments, kMaxGroupSegments + 9}) {
        std::vector<Segment> segments;
        for (std::size_t s = 0; s < count; ++s) {
            auto cells = cells_of_every_kind();
            std::shuffle(cells.begin(), cells.end(), random);
            segments.push_back(segment_of(cells, (s + count) % 17));
        }
        const auto list = weighted(segments);
        const std::uint32_t blocks = segments[0].block_count;
        std::vector<float> expected(blocks * kColours * kBlockSize, 0.75F);
        std::vector<float> expected_total(expected.size(), 0.25F);
        accumulate_segments_scalar(list, blocks,
                                   {.sums = expected.data(), .total = expected_total.data()});
        for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().DeInit();
            for (std::size_t misalignment = 0; misalignment < kMostLanes; ++misalignment) {
                // Sums and total are off the alignment of vectors by different numbers of
                // floats; one float behind each shows that nothing beside them is written.
                const std::size_t other = kMostLanes - 1 - misalignment;
                std::vector<float> sums(misalignment + expected.size() + 1, 0.75F);
                std::vector<float> total(other + expected.size() + 1, 0.25F);
                accumulate_segments(
                    list, blocks,
                    {.sums = sums.data() + misalignment, .total = total.data() + other});
                const auto name = hwy::TargetName(target);
                EXPECT_TRUE(
                    std::equal(expected.begin(), expected.end(), sums.data() + misalignment))
                    << count << " segments, " << misalignment << " floats off, on " << name;
                EXPECT_TRUE(std::equal(expected_total.begin(), expected_total.end(),
                                       total.data() + other))
                    << count << " segments, " << other << " floats off, on " << name;
                EXPECT_TRUE(std::all_of(sums.data(), sums.data() + misalignment,
                                        [](float value) { return value == 0.75F; }));
                EXPECT_EQ(sums.back(), 0.75F);
                EXPECT_EQ(total.back(), 0.25F);
            }
        }
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
    }
}

TEST(Accumulate, LeavesTheBlocksOfOtherShardsAlone) {
    const std::vector<Segment> segments{segment_of({QuantisedCell{1, 2, 3}}, 0)};
    std::vector<float> sums(2 * kColours * kBlockSize);
    accumulate_segments(weighted(segments), 1, {.sums = sums.data()});
    EXPECT_TRUE(std::all_of(sums.begin() + kColours * kBlockSize, sums.end(),
                            [](float value) { return value == 0; }));
}

}  // namespace
}  // namespace relume::engine
