// The cells of a stored segment, block by block.
#pragma once

#include "protocol/transport/cell.h"

#include <cstdint>

namespace relume::lab {

// Calls visit(block, values) for each of the shard's `block_count` blocks that has a cell:
// 256 values, in steps. `values` is room for them.
template <typename Visit>
void for_each_cell(const transport::SegmentView& segment,
                   std::uint32_t block_count,
                   transport::DecodedCell& values,
                   const Visit& visit) {
    if (segment.empty()) {
        return;
    }
    const std::uint8_t* cell = segment.cells;
    for (std::uint32_t block = 0; block < block_count; ++block) {
        const transport::CellTag tag = segment.tag(block);
        if (tag != transport::CellTag::empty) {
            cell = transport::decode_cell(tag, cell, values);
            visit(block, values);
        }
    }
}

}  // namespace relume::lab
