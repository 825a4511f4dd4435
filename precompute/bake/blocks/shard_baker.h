// All blocks of one shard: rows, channels, integers, cells.
#pragma once

#include "precompute/bake/blocks/block_rows.h"
#include "precompute/bake/blocks/error_meter.h"
#include "precompute/bake/blocks/pilot.h"
#include "precompute/bake/blocks/shard_notes.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/bake/rows/traced_receivers.h"
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
    ShardBaker(const RowBaker& rows,
               const TracedReceivers& traced,
               const Quantisation& quantisation,
               std::uint64_t seed);

    // Called with receivers and rays done, by any thread; false stops the bake.
    using Tick = std::function<bool(std::uint64_t receivers, std::uint64_t rays)>;

    // These blocks are in reach of the traced receivers. Throws BakeInterrupted.
    [[nodiscard]] BakedShard bake(std::uint32_t first_block,
                                  std::uint32_t block_count,
                                  const Tick& tick) const;

  private:
    struct Scratch;
    struct Block;

    [[nodiscard]] BlockErrors measure(Block& block) const;
    void bake_receiver(const TracedReceiver& receiver,
                       std::uint32_t slot,
                       Block& block,
                       Scratch& scratch) const;
    [[nodiscard]] transport::EncodedBlock bake_block(std::uint32_t number,
                                                     std::span<float> tint,
                                                     BlockRows& rows,
                                                     BlockErrors& errors,
                                                     BlockSample& sample,
                                                     std::uint64_t& rays,
                                                     const Tick& tick) const;

    const RowBaker& rows_;
    const TracedReceivers& traced_;
    PathPool pool_;
    BlockPatch patch_;
    const Quantisation& quantisation_;
    std::uint64_t seed_;  // of the receivers that are sampled
    ModelLights lights_;
    ErrorMeter meter_;
};

}  // namespace relume::bake
