#include "server/engine/operators/column_segments.h"

namespace relume::engine {
namespace {

ColourWeights weights_of(const transport::Transport& transport,
                         const ColumnChange& change,
                         std::uint32_t channel) {
    const transport::ColourModel& colour = transport.manifest().colour;
    const float step = transport.step(change.column, channel);
    ColourWeights weights;
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        weights[c] = step * colour.matrix[c][channel] * change.amount(c);
    }
    return weights;
}

}  // namespace

void gather_segments(const transport::Transport& transport,
                     std::size_t shard,
                     std::span<const ColumnChange> changes,
                     std::vector<WeightedSegment>& segments) {
    const transport::ShardReader& reader = transport.shards()[shard];
    segments.clear();
    for (const ColumnChange& change : changes) {
        for (std::uint32_t k = 0; k < transport.channel_count(); ++k) {
            const transport::SegmentView segment = reader.segment(change.column, k);
            if (!segment.empty()) {
                segments.push_back(
                    {.segment = segment, .weights = weights_of(transport, change, k)});
            }
        }
    }
}

std::uint64_t occupied_blocks(std::span<const WeightedSegment> segments,
                              std::uint32_t block_count) {
    std::uint64_t occupied = 0;
    for (const WeightedSegment& weighted : segments) {
        occupied |= weighted.segment.occupied_blocks(block_count);
    }
    return occupied;
}

}  // namespace relume::engine
