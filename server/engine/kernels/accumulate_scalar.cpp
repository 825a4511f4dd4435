#include "server/engine/kernels/accumulate.h"

#include <algorithm>

namespace relume::engine {
namespace {

using transport::CellTag;
using transport::DecodedCell;
using transport::kBlockSize;
using transport::kColours;

// Adds the next block's cell of one segment if it is, or is not, sparse; moves past it.
const std::uint8_t* add_cell(const WeightedSegment& segment,
                             std::uint32_t block,
                             const std::uint8_t* cell,
                             bool sparse,
                             float* sums) {
    const CellTag tag = segment.segment.tag(block);
    if (tag == CellTag::empty || (tag == CellTag::sparse8) != sparse) {
        return cell;
    }
    DecodedCell values;
    const std::uint8_t* end = transport::decode_cell(tag, cell, values);
    for (std::size_t c = 0; c < kColours; ++c) {
        for (std::size_t i = 0; i < kBlockSize; ++i) {
            sums[c * kBlockSize + i] += segment.weights[c] * values[i];
        }
    }
    return end;
}

void accumulate_group(std::span<const WeightedSegment> group,
                      std::uint32_t block_count,
                      float* sums) {
    std::array<const std::uint8_t*, kSegmentGroup> cells{};
    for (std::size_t s = 0; s < group.size(); ++s) {
        cells[s] = group[s].segment.cells;
    }
    for (std::uint32_t block = 0; block < block_count; ++block) {
        float* block_sums = sums + std::size_t{block} * kColours * kBlockSize;
        for (const bool sparse : {false, true}) {
            for (std::size_t s = 0; s < group.size(); ++s) {
                cells[s] = add_cell(group[s], block, cells[s], sparse, block_sums);
            }
        }
    }
}

}  // namespace

void accumulate_segments_scalar(std::span<const WeightedSegment> segments,
                                std::uint32_t block_count,
                                float* sums) {
    for (std::size_t first = 0; first < segments.size(); first += kSegmentGroup) {
        const std::size_t count = std::min(kSegmentGroup, segments.size() - first);
        accumulate_group(segments.subspan(first, count), block_count, sums);
    }
}

}  // namespace relume::engine
