#include "server/engine/kernels/accumulate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace relume::engine {
namespace {

using transport::CellTag;
using transport::DecodedCell;
using transport::kBlockSize;
using transport::kColours;

enum class CellKind : std::uint8_t { empty, bits8, bits16, floats, strips };

// Of the low part, if the cell is split.
CellKind kind_of(CellTag tag) {
    switch (transport::low_tag(tag)) {
        case CellTag::empty:
            return CellKind::empty;
        case CellTag::dense8:
            return CellKind::bits8;
        case CellTag::dense16:
            return CellKind::bits16;
        case CellTag::dense32f:
            return CellKind::floats;
        case CellTag::strips8:
            return CellKind::strips;
        default:
            return CellKind::empty;
    }
}

// Sums of one block, [3][256].
using BlockSums = std::array<float, kColours * kBlockSize>;

void add_values(const DecodedCell& values,
                const ColourWeights& weights,
                float scale,
                BlockSums& sums) {
    for (std::size_t c = 0; c < kColours; ++c) {
        for (std::size_t i = 0; i < kBlockSize; ++i) {
            float& sum = sums[c * kBlockSize + i];
            sum = std::fma(scale * weights[c], values[i], sum);
        }
    }
}

// Adds the block's cells of one kind up, in the order of the segments; whether there are any.
// `cells` are those of this block.
bool add_cells(std::span<const WeightedSegment> segments,
               std::span<const std::uint8_t* const> cells,
               std::uint32_t block,
               CellKind kind,
               BlockSums& sums) {
    bool any = false;
    for (std::size_t s = 0; s < segments.size(); ++s) {
        CellTag tag = segments[s].segment.tag(block);
        const std::uint8_t* cell = cells[s];
        DecodedCell values;
        auto scale = static_cast<float>(std::pow(transport::kPartBase, upper_parts(tag)));
        for (std::size_t part = upper_parts(tag); part > 0; --part) {
            cell = transport::decode_cell(CellTag::strips8, cell, values);
            if (kind == CellKind::strips) {
                add_values(values, segments[s].weights, scale, sums);
                any = true;
            }
            scale /= transport::kPartBase;
        }
        tag = transport::low_tag(tag);
        if (kind_of(tag) == kind && kind != CellKind::empty) {
            transport::decode_cell(tag, cell, values);
            add_values(values, segments[s].weights, 1, sums);
            any = true;
        }
    }
    return any;
}

void add_to_targets(const BlockSums& sums, std::uint32_t block, const SumTargets& targets) {
    const std::size_t first = std::size_t{block} * sums.size();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        targets.sums[first + i] += sums[i];
        if (targets.total != nullptr) {
            targets.total[first + i] += sums[i];
        }
    }
}

}  // namespace

void accumulate_segments_scalar(std::span<const WeightedSegment> segments,
                                std::uint32_t block_count,
                                const SumTargets& targets) {
    std::vector<const std::uint8_t*> cells;
    for (const WeightedSegment& segment : segments) {
        cells.push_back(segment.segment.cells);
    }
    for (std::uint32_t block = 0; block < block_count; ++block) {
        BlockSums sums{};
        bool any = false;
        for (std::size_t first = 0; first < segments.size();) {
            const auto group = next_group(segments.subspan(first));
            const auto group_cells = std::span(cells).subspan(first, group.size());
            for (const CellKind kind : {CellKind::bits8, CellKind::bits16, CellKind::floats}) {
                any = add_cells(group, group_cells, block, kind, sums) || any;
            }
            first += group.size();
        }
        BlockSums strips{};
        if (add_cells(segments, cells, block, CellKind::strips, strips)) {
            std::transform(sums.begin(), sums.end(), strips.begin(), sums.begin(),
                           std::plus<>());
            any = true;
        }
        if (any) {
            add_to_targets(sums, block, targets);
        }
        for (std::size_t s = 0; s < segments.size(); ++s) {
            cells[s] += transport::cell_bytes(segments[s].segment.tag(block), cells[s]);
        }
    }
}

}  // namespace relume::engine
