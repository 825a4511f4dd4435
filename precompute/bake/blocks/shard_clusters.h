// Which clusters, and so which blocks, make a shard.
#pragma once

#include "precompute/bake/receivers/receivers.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

// Clusters [first_cluster, first_cluster + cluster_count), whose terms are the blocks from
// first_block on.
struct ShardClusters {
    std::uint32_t first_cluster = 0;
    std::uint32_t cluster_count = 0;
    std::uint32_t first_block = 0;
    std::uint32_t block_count = 0;
};

// All shards of a bake, in order: as many clusters as the receivers allow and a shard's blocks
// hold.
[[nodiscard]] std::vector<ShardClusters> shards_of(const Receivers& receivers);

}  // namespace relume::bake
