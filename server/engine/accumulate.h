// The inner loop of relighting: one stored column, times three weights, added to sums.
#pragma once

#include "protocol/transport/cell.h"

#include <array>
#include <cstdint>

namespace relume::engine {

// Weight per colour: step·matrix[c][k]·ΔL(j,c).
using ColourWeights = std::array<float, transport::kColours>;

// For every block b of the shard, colour c and slot i: sums[b][c][i] += weights[c]·q(b,i).
// `segment` is not empty; `sums` is [block_count][3][256]. This is the specification; blocks
// are visited in order and every sum receives at most one addition, so any vectorisation gives
// the same bits.
void accumulate_segment(const transport::SegmentView& segment,
                        std::uint32_t block_count,
                        const ColourWeights& weights,
                        float* sums);

}  // namespace relume::engine
