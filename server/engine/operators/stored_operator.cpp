#include "server/engine/operators/stored_operator.h"

#include "server/engine/operators/column_segments.h"

#include <utility>

namespace relume::engine {
namespace {

ColumnTable::Columns columns_of(const transport::Transport& transport) {
    return {.bands = transport.manifest().signal_basis.bands(),
            .energies = transport.energies(),
            .bytes = transport.column_bytes(),
            .stating = transport.stating_sketch(),
            .choosing = transport.choosing_sketch()};
}

}  // namespace

StoredOperator::StoredOperator(std::shared_ptr<const transport::Transport> transport)
    : TransportOperator(columns_of(*transport), transport->manifest().block_count()),
      transport_(std::move(transport)),
      strips_(*transport_, columns()) {}

std::size_t StoredOperator::run_count() const {
    return transport_->shards().size();
}

TransportOperator::BlockRun StoredOperator::run(std::size_t number) const {
    const transport::ShardReader& shard = transport_->shards()[number];
    return {.first = shard.first_block(), .count = shard.block_count()};
}

void StoredOperator::add(std::size_t run,
                         std::span<const ColumnChange> changes,
                         const RunSums& targets) const {
    const std::uint32_t blocks = transport_->shards()[run].block_count();
    thread_local std::vector<WeightedSegment> segments;
    gather_segments(*transport_, run, changes, segments);
    accumulate_segments(segments, blocks, {.sums = targets.sums, .total = targets.total});
    if (targets.occupied != nullptr) {
        *targets.occupied = occupied_blocks(segments, blocks);
    }
}

void StoredOperator::set_weights(std::span<const float> signal, Weights& weights) const {
    strips_.set_weights(*transport_, signal, weights);
}

void StoredOperator::multiply(std::uint32_t block,
                              std::uint32_t band,
                              std::span<const Member> members) const {
    strips_.multiply(block, band, members);
}

std::uint32_t StoredOperator::bands_of_block(std::uint32_t block) const {
    return strips_.bands_of_block(block);
}

std::uint64_t StoredOperator::product_bytes_of_block(std::uint32_t block) const {
    return strips_.bytes_of_block(block);
}

std::uint64_t StoredOperator::product_bytes() const {
    return strips_.bytes();
}

}  // namespace relume::engine
