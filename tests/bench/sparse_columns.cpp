#include "tests/bench/sparse_columns.h"

namespace relume::bench {

ColumnIndex::ColumnIndex(std::span<const std::uint32_t> columns, std::uint32_t channels)
    : channels_(channels) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        positions_.emplace(columns[i], i);
    }
}

void for_each_value(const transport::ShardReader& shard,
                    std::uint32_t column,
                    std::uint32_t channel,
                    const VisitValue& visit) {
    const transport::SegmentView segment = shard.segment(column, channel);
    if (segment.empty()) {
        return;
    }
    const std::uint8_t* cell = segment.cells;
    transport::DecodedCell values;
    for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
        if (segment.tag(block) == transport::CellTag::empty) {
            continue;
        }
        cell = transport::decode_cell(segment.tag(block), cell, values);
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            if (values[slot] != 0) {
                visit(block, slot, values[slot]);
            }
        }
    }
}

std::array<float, transport::kColours> channel_weights(const engine::Scene& scene,
                                                       const engine::ColumnChange& change,
                                                       std::uint32_t channel) {
    const auto& matrix = scene.transport().manifest().colour.matrix;
    std::array<float, transport::kColours> weights{};
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        weights[c] = matrix[c][channel] * change.amount[c];
    }
    return weights;
}

}  // namespace relume::bench
