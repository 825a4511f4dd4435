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

// Segments are taken this many at a time, so that sums go through the registers once for all.
inline constexpr std::size_t kSegmentGroup = 8;

// For every segment s, block b of the shard, colour c and slot i:
//     sums[b][c][i] += weights(s,c)·q(s,b,i)
// `sums` is [block_count][3][256]. The order of additions is part of the contract: within each
// group of kSegmentGroup segments a block receives first its dense and bitmap cells, then its
// sparse cells, both in the order of the segments, a product rounded before it is added. So
// every target gives the same bits.
using AccumulateSegments = void(std::span<const WeightedSegment> segments,
                                std::uint32_t block_count,
                                float* sums);

// The specification: one value at a time.
AccumulateSegments accumulate_segments_scalar;
// The best the processor has, or what RELUME_FORCE_TARGET names (kernels/target.h).
AccumulateSegments accumulate_segments;

}  // namespace relume::engine
