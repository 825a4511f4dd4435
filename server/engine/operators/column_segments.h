// The stored segments of changed columns, with their weights, as the kernel takes them.
#pragma once

#include "protocol/transport/transport.h"
#include "server/engine/columns/column_change.h"
#include "server/engine/kernels/accumulate.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Replaces `segments` by those of the changed columns in one shard, with their weights.
void gather_segments(const transport::Transport& transport,
                     std::size_t shard,
                     std::span<const ColumnChange> changes,
                     std::vector<WeightedSegment>& segments);

// Bit b: any of the segments has a cell in block b of the shard, which has `block_count`.
[[nodiscard]] std::uint64_t occupied_blocks(std::span<const WeightedSegment> segments,
                                            std::uint32_t block_count);

}  // namespace relume::engine
