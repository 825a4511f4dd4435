// The inner loop of relighting: stored columns, each times three weights, added to sums.
#pragma once

#include "protocol/transport/cell.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

// Weight per colour: step·matrix[c][k]·ΔL(j,c).
using ColourWeights = std::array<float, transport::kColours>;

struct WeightedSegment {
    transport::SegmentView segment;  // not empty
    ColourWeights weights;
};

// Where the segments of one shard are added: [block_count][3][256], with no overlap. `total`
// may be null.
struct SumTargets {
    float* sums = nullptr;
    float* total = nullptr;
};

// Segments are taken in groups, so that a block's sums go through the registers once for many
// cells, and so that a group's cells stay in the second-level cache.
inline constexpr std::size_t kMaxGroupSegments = 256;
inline constexpr std::size_t kMaxGroupBytes = std::size_t{256} << 10U;

// The first group of those that are left; at least one segment. Where groups end depends on the
// list alone.
[[nodiscard]] inline std::span<const WeightedSegment> next_group(
    std::span<const WeightedSegment> left) {
    std::size_t count = 0;
    std::size_t bytes = 0;
    while (count < left.size() && count < kMaxGroupSegments && bytes < kMaxGroupBytes) {
        const transport::SegmentView& segment = left[count++].segment;
        bytes += static_cast<std::size_t>(segment.end - segment.cells);
    }
    return left.first(count);
}

// For every segment s, block b of the shard, colour c and slot i, adds weights(s,c)·q(s,b,i) to
// both targets. The order is part of the contract, so that every instruction set gives the same
// bits:
// - a block's dense cells are added up from zero, group by group; of each group its 8-bit
//   cells, then its 16-bit cells, then its float cells, each in the order of the segments;
// - by themselves all its cells of strips are added up from zero in the order of the segments,
//   the higher parts of a split cell, with 256 or 65536 times the weight, before the lower;
// - strips' sums are added to dense cells' sums, and these to the targets;
// - every product is added without rounding in between (fused multiply-add).
using AccumulateSegments = void(std::span<const WeightedSegment> segments,
                                std::uint32_t block_count,
                                const SumTargets& targets);

// The specification: one value at a time.
AccumulateSegments accumulate_segments_scalar;
// The best the processor has, or what RELUME_FORCE_TARGET names (kernels/target.h).
AccumulateSegments accumulate_segments;

}  // namespace relume::engine
