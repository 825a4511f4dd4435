// A block's rows to its cells: transposed, transformed over the block, quantised, encoded.
#pragma once

#include "precompute/bake/blocks/block_rows.h"
#include "protocol/transport/block_basis.h"
#include "protocol/transport/shard_writer.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// What some receivers' rows have become by being stored, to measure the error by.
struct StoredRows {
    std::vector<std::uint32_t> slots;
    std::vector<std::vector<float>> rows;  // by slot, [K][N]
};

// `steps` is [N][K]. Fills the rows of `stored` for the slots it names.
[[nodiscard]] transport::EncodedBlock encode_block(transport::BlockBasis basis,
                                                   const BlockRows& rows,
                                                   std::span<const float> steps,
                                                   StoredRows& stored);

}  // namespace relume::bake
