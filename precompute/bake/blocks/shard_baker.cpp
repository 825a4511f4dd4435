#include "precompute/bake/blocks/shard_baker.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/blocks/block_encoder.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace relume::bake {

struct ShardBaker::Scratch {
    CoefficientRow row;
    ChannelRow channels;
    RowBaker::Scratch rows;
};

struct ShardBaker::Block {
    BlockRows& rows;
    std::span<float> tint;  // [3][256]
    // Of the slots in `stored`.
    std::vector<ErrorMeter::LitReceiver> measured;
    std::vector<BakedColours> lit;  // of those that see anything
    StoredRows stored;
};

ShardBaker::ShardBaker(const RowBaker& rows,
                       const TracedReceivers& traced,
                       const Quantisation& quantisation,
                       std::uint64_t seed)
    : rows_(rows),
      traced_(traced),
      pool_(traced),
      patch_(traced.receivers().patch()),
      quantisation_(quantisation),
      seed_(seed),
      lights_(rows.projection()),
      meter_(lights_, quantisation) {}

BakedShard ShardBaker::bake(std::uint32_t first_block,
                            std::uint32_t block_count,
                            const Tick& tick) const {
    BakedShard shard;
    shard.blocks.assign(block_count, transport::EncodedBlock(0));
    constexpr std::size_t kTintValues =
        std::size_t{transport::kColours} * transport::kBlockSize;
    // Receivers without a surface stay black, whatever the block's coefficients say of them.
    shard.notes.tint.assign(block_count * kTintValues, 0.0F);
    shard.notes.errors.resize(block_count);
    shard.notes.samples.resize(block_count);
    std::atomic<std::uint64_t> rays = 0;
    const std::uint32_t channels = quantisation_.colour.channels;
    tbb::enumerable_thread_specific<BlockRows> rows(quantisation_.steps.size() / channels,
                                                    channels);
    tbb::parallel_for(std::uint32_t{0}, block_count, [&](std::uint32_t i) {
        std::uint64_t cast = 0;
        shard.blocks[i] = bake_block(
            first_block + i, std::span(shard.notes.tint).subspan(i * kTintValues, kTintValues),
            rows.local(), shard.notes.errors[i], shard.notes.samples[i], cast, tick);
        rays += cast;
    });
    shard.rays = rays;
    return shard;
}

transport::EncodedBlock ShardBaker::bake_block(std::uint32_t number,
                                               std::span<float> tint,
                                               BlockRows& rows,
                                               BlockErrors& errors,
                                               BlockSample& sample,
                                               std::uint64_t& rays,
                                               const Tick& tick) const {
    static thread_local Scratch scratch;
    const Receivers& receivers = traced_.receivers();
    rows.clear();
    Block block{.rows = rows, .tint = tint, .measured = {}, .lit = {}, .stored = {}};
    constexpr std::uint32_t kSlotsPerTick = 16;
    for (std::uint32_t first = 0; first < transport::kBlockSize; first += kSlotsPerTick) {
        const std::uint64_t before = scratch.rows.direct.visibility.rays;
        std::uint64_t baked = 0;
        for (std::uint32_t slot = first; slot < first + kSlotsPerTick; ++slot) {
            if (const auto receiver = receivers.receiver_at(number, slot)) {
                bake_receiver(traced_.at(*receiver), slot, block, scratch);
                ++baked;
            }
        }
        const std::uint64_t cast = scratch.rows.direct.visibility.rays - before;
        rays += cast;
        if (!tick(baked, cast)) {
            throw BakeInterrupted("stopped before all shards were finished");
        }
    }
    transport::EncodedBlock encoded = encode_block(rows, quantisation_.steps, block.stored);
    errors = measure(block);
    sample = sample_block(receivers, block.lit, seed_ + number);
    return encoded;
}

void ShardBaker::bake_receiver(const TracedReceiver& receiver,
                               std::uint32_t slot,
                               Block& block,
                               Scratch& scratch) const {
    if (receiver.receiver.surfaces.empty()) {
        return;
    }
    rows_.bake(receiver, &pool_, scratch.row, scratch.rows);
    block.lit.push_back(
        {.receiver = receiver.receiver.index, .colours = lights_.colours(scratch.row)});
    const transport::ColourModel& colour = quantisation_.colour;
    split_colours(colour, scratch.row, scratch.channels);
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        block.tint[c * transport::kBlockSize + slot] =
            scratch.channels.tint[static_cast<int>(c)];
    }
    for (std::uint32_t k = 0; k < colour.channels; ++k) {
        block.rows.set(slot, k, scratch.channels.channel[k]);
    }
    if (std::find(patch_.slots.begin(), patch_.slots.end(), slot) != patch_.slots.end()) {
        block.stored.slots.push_back(slot);
        block.measured.emplace_back().exact = block.lit.back().colours;
    }
}

BlockErrors ShardBaker::measure(Block& block) const {
    std::vector<ErrorMeter::LitReceiver> patch(patch_.slots.size());
    for (std::size_t i = 0; i < block.measured.size(); ++i) {
        const std::uint32_t slot = block.stored.slots[i];
        Imath::V3f tint;
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            tint[static_cast<int>(c)] = block.tint[c * transport::kBlockSize + slot];
        }
        meter_.measure_stored(block.stored.rows[i], tint, block.measured[i]);
        const auto place = std::find(patch_.slots.begin(), patch_.slots.end(), slot);
        patch[static_cast<std::size_t>(place - patch_.slots.begin())] = block.measured[i];
    }
    return ErrorMeter::errors(patch_, patch);
}

}  // namespace relume::bake
