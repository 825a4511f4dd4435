#include "precompute/bake/blocks/shard_clusters.h"

#include "protocol/transport/format.h"

namespace relume::bake {

std::vector<ShardClusters> shards_of(const Receivers& receivers) {
    std::vector<ShardClusters> shards;
    std::uint32_t blocks = 0;
    for (std::uint32_t cluster = 0; cluster < receivers.cluster_count(); ++cluster) {
        const std::uint32_t terms = receivers.terms(cluster);
        if (shards.empty() || shards.back().cluster_count == receivers.clusters_per_shard() ||
            shards.back().block_count + terms > transport::kMaxBlocksPerShard) {
            shards.push_back({.first_cluster = cluster, .first_block = blocks});
        }
        ++shards.back().cluster_count;
        shards.back().block_count += terms;
        blocks += terms;
    }
    return shards;
}

}  // namespace relume::bake
