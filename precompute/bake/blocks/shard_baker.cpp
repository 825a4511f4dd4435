#include "precompute/bake/blocks/shard_baker.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/blocks/block_encoder.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace relume::bake {
namespace {

constexpr std::size_t kTintValues = std::size_t{transport::kColours} * transport::kBlockSize;

}  // namespace

struct ShardBaker::Scratch {
    std::vector<CoefficientRow> terms;
    ChannelRow channels;
};

struct ShardBaker::Block {
    BlockRows& rows;
    std::span<float> tint;  // [3][256]
    // Of the slots in `stored`.
    std::vector<ErrorMeter::LitReceiver> measured;
    StoredRows stored;
};

ShardBaker::ShardBaker(const RowSource& rows,
                       const Quantisation& quantisation,
                       std::uint64_t seed)
    : rows_(rows),
      patch_(rows.receivers().patch()),
      quantisation_(quantisation),
      seed_(seed),
      signals_(rows.signals()),
      meter_(signals_, quantisation) {}

BakedShard ShardBaker::bake(const ShardClusters& clusters, const Tick& tick) const {
    const Receivers& receivers = rows_.receivers();
    BakedShard shard;
    shard.blocks.assign(clusters.block_count, transport::EncodedBlock(0));
    // Receivers without a surface stay black, whatever the block's coefficients say of them.
    shard.notes.tint.assign(clusters.block_count * kTintValues, 0.0F);
    shard.notes.errors.resize(clusters.block_count);
    shard.notes.samples.resize(clusters.cluster_count);
    std::vector<std::uint32_t> first_block;
    std::uint32_t blocks = 0;
    for (std::uint32_t i = 0; i < clusters.cluster_count; ++i) {
        first_block.push_back(blocks);
        blocks += receivers.terms(clusters.first_cluster + i);
    }
    std::atomic<std::uint64_t> rays = 0;
    const std::uint32_t channels = quantisation_.colour.channels;
    tbb::enumerable_thread_specific<std::vector<BlockRows>> rows;
    tbb::parallel_for(std::uint32_t{0}, clusters.cluster_count, [&](std::uint32_t i) {
        const std::uint32_t number = clusters.first_cluster + i;
        std::vector<BlockRows>& own = rows.local();
        while (own.size() < receivers.terms(number)) {
            own.emplace_back(quantisation_.steps.size() / channels, channels);
        }
        std::uint64_t cast = 0;
        bake_cluster(number, first_block[i], std::span(own).first(receivers.terms(number)),
                     shard, shard.notes.samples[i], cast, tick);
        rays += cast;
    });
    shard.rays = rays;
    return shard;
}

void ShardBaker::bake_cluster(std::uint32_t number,
                              std::uint32_t first_block,
                              std::span<BlockRows> rows,
                              BakedShard& shard,
                              ClusterSample& sample,
                              std::uint64_t& rays,
                              const Tick& tick) const {
    static thread_local Scratch scratch;
    const Receivers& receivers = rows_.receivers();
    std::vector<Block> blocks;
    for (std::size_t term = 0; term < rows.size(); ++term) {
        rows[term].clear();
        blocks.push_back({.rows = rows[term],
                          .tint = std::span(shard.notes.tint)
                                      .subspan((first_block + term) * kTintValues, kTintValues),
                          .measured = {},
                          .stored = {}});
    }
    std::vector<BakedColours> lit;
    constexpr std::uint32_t kSlotsPerTick = 16;
    for (std::uint32_t first = 0; first < transport::kBlockSize; first += kSlotsPerTick) {
        std::uint64_t cast = 0;
        std::uint64_t baked = 0;
        for (std::uint32_t slot = first; slot < first + kSlotsPerTick; ++slot) {
            const auto receiver = receivers.receiver_at(number, slot);
            if (!receiver) {
                continue;
            }
            ++baked;
            if (!rows_.bake(*receiver, scratch.terms, cast)) {
                continue;
            }
            lit.push_back(
                {.receiver = *receiver, .colours = signals_.colours(scratch.terms.front())});
            for (std::size_t term = 0; term < blocks.size(); ++term) {
                set_row(scratch.terms[term], slot, blocks[term], scratch);
            }
        }
        rays += cast;
        if (!tick(baked, cast)) {
            throw BakeInterrupted("stopped before all shards were finished");
        }
    }
    for (std::size_t term = 0; term < blocks.size(); ++term) {
        Block& block = blocks[term];
        shard.blocks[first_block + term] = encode_block(quantisation_.block_basis, block.rows,
                                                        quantisation_.steps, block.stored);
        shard.notes.errors[first_block + term] = measure(block);
    }
    sample = sample_cluster(receivers, lit, seed_ + number);
}

void ShardBaker::set_row(const CoefficientRow& row,
                         std::uint32_t slot,
                         Block& block,
                         Scratch& scratch) const {
    const transport::ColourModel& colour = quantisation_.colour;
    split_colours(colour, row, scratch.channels);
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        block.tint[c * transport::kBlockSize + slot] =
            scratch.channels.tint[static_cast<int>(c)];
    }
    for (std::uint32_t k = 0; k < colour.channels; ++k) {
        block.rows.set(slot, k, scratch.channels.channel[k]);
    }
    if (std::find(patch_.slots.begin(), patch_.slots.end(), slot) != patch_.slots.end()) {
        block.stored.slots.push_back(slot);
        block.measured.emplace_back().exact = signals_.colours(row);
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
