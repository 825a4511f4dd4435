// Changed columns as the kernel takes them.
#pragma once

#include "protocol/transport/transport.h"
#include "server/engine/column_change.h"
#include "server/engine/kernels/accumulate.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Replaces `segments` by those of the changed columns in one shard, with their weights. Returns
// the blocks of the shard in which they have cells, a bit each.
std::uint64_t gather_segments(const transport::Transport& transport,
                              std::size_t shard,
                              std::span<const ColumnChange> changes,
                              std::vector<WeightedSegment>& segments);

}  // namespace relume::engine
