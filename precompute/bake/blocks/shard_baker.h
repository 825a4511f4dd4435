// All blocks of one shard: rows, channels, integers, cells.
#pragma once

#include "precompute/bake/blocks/block_rows.h"
#include "precompute/bake/blocks/error_meter.h"
#include "precompute/bake/blocks/pilot.h"
#include "precompute/bake/blocks/row_source.h"
#include "precompute/bake/blocks/shard_notes.h"
#include "protocol/transport/shard_writer.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace relume::bake {

struct BakedShard {
    std::vector<transport::EncodedBlock> blocks;
    ShardNotes notes;
    std::uint64_t rays = 0;
};

class ShardBaker {
  public:
    // Keeps references to both. `seed`: of the receivers that are sampled.
    ShardBaker(const RowSource& rows, const Quantisation& quantisation, std::uint64_t seed);

    // Called with receivers and rays done, by any thread; false stops the bake.
    using Tick = std::function<bool(std::uint64_t receivers, std::uint64_t rays)>;

    // The rows are ready for these clusters. Throws BakeInterrupted.
    [[nodiscard]] BakedShard bake(const ShardClusters& clusters, const Tick& tick) const;

  private:
    struct Scratch;
    struct Block;

    [[nodiscard]] BlockErrors measure(Block& block) const;
    void set_row(const CoefficientRow& row,
                 std::uint32_t slot,
                 Block& block,
                 Scratch& scratch) const;
    // Writes a cluster's blocks, one for each of its terms, from `first_block` of the shard on.
    void bake_cluster(std::uint32_t number,
                      std::uint32_t first_block,
                      std::span<BlockRows> rows,
                      BakedShard& shard,
                      ClusterSample& sample,
                      std::uint64_t& rays,
                      const Tick& tick) const;

    const RowSource& rows_;
    ClusterPatch patch_;
    const Quantisation& quantisation_;
    std::uint64_t seed_;
    ModelSignals signals_;
    ErrorMeter meter_;
};

}  // namespace relume::bake
