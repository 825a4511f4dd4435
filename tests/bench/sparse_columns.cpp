#include "tests/bench/sparse_columns.h"

#include "protocol/transport/block_basis.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relume::bench {

using transport::kBlockSize;
using transport::kColours;

std::string_view name_from(PeerBasis basis) {
    switch (basis) {
        case PeerBasis::pixels:
            return "by pixel";
        case PeerBasis::ours:
            return "in our basis";
    }
    return "";
}

SparseColumns::SparseColumns(const served::Scene& scene,
                             std::span<const std::uint32_t> columns,
                             PeerBasis basis,
                             float levels)
    : scene_(&scene),
      basis_(basis),
      channels_(scene.transport().channel_count()),
      columns_(columns.begin(), columns.end()),
      scales_(columns.size() * channels_) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        places_.emplace(columns_[i], i);
    }
    tbb::parallel_for(std::size_t{0}, scales_.size(), [&](std::size_t position) {
        const std::uint32_t channel = static_cast<std::uint32_t>(position % channels_);
        scales_[position] =
            basis_ == PeerBasis::ours
                ? scene.transport().step(columns_[position / channels_], channel)
                : largest_magnitude(position) / levels;
    });
}

void SparseColumns::for_each_block(const transport::ShardReader& shard,
                                   std::size_t position,
                                   const VisitBlock& visit) const {
    const std::uint32_t column = columns_[position / channels_];
    const auto channel = static_cast<std::uint32_t>(position % channels_);
    const transport::SegmentView segment = shard.segment(column, channel);
    if (segment.empty()) {
        return;
    }
    const float step = scene_->transport().step(column, channel);
    const std::uint8_t* cell = segment.cells;
    Values values;
    for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
        if (segment.tag(block) == transport::CellTag::empty) {
            continue;
        }
        cell = transport::decode_cell(segment.tag(block), cell, values);
        for (float& value : values) {
            value *= step;
        }
        if (basis_ == PeerBasis::pixels) {
            transport::block_receivers_from_coefficients(transport::BlockBasis::haar_tile,
                                                         values);
            keep_covered(shard.first_block() + block, values);
        }
        visit(block, values);
    }
}

// What the bake fills the rest with is of no pixel, and no peer would hold it.
void SparseColumns::keep_covered(std::uint32_t block,
                                 std::span<float, kBlockSize> pixels) const {
    const auto coverage =
        scene_->transport().coverage().subspan(std::size_t{block} * kBlockSize, kBlockSize);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        pixels[slot] = coverage[slot] > 0 ? pixels[slot] : 0;
    }
}

float SparseColumns::largest_magnitude(std::size_t position) const {
    float largest = 0;
    for (const auto& shard : scene_->transport().shards()) {
        for_each_block(shard, position, [&](std::uint32_t, const Values& values) {
            for (const float value : values) {
                largest = std::max(largest, std::abs(value));
            }
        });
    }
    return largest;
}

void SparseColumns::for_each_entry(const transport::ShardReader& shard,
                                   std::size_t position,
                                   const VisitEntry& visit) const {
    const float scale = scales_[position];
    for_each_block(shard, position, [&](std::uint32_t block, const Values& values) {
        for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
            const float value = values[slot];
            const auto integer =
                value == 0 ? 0 : static_cast<std::int32_t>(std::lround(value / scale));
            if (integer != 0) {
                visit({.block = block, .slot = slot, .integer = integer, .value = value});
            }
        }
    });
}

std::vector<float> SparseColumns::image_from_sums(std::span<const float> sums) const {
    std::vector<float> image(sums.begin(), sums.end());
    for (std::size_t part = 0; basis_ == PeerBasis::pixels && part < image.size() / kBlockSize;
         ++part) {
        const std::span<float, kBlockSize> values(&image[part * kBlockSize], kBlockSize);
        transport::block_receivers_from_coefficients(transport::BlockBasis::haar_tile, values);
        keep_covered(static_cast<std::uint32_t>(part / kColours), values);
    }
    return image;
}

std::array<float, kColours> channel_weights(const served::Scene& scene,
                                            const engine::ColumnChange& change,
                                            std::uint32_t channel) {
    const auto& matrix = scene.transport().manifest().colour.matrix;
    std::array<float, kColours> weights{};
    for (std::size_t c = 0; c < kColours; ++c) {
        weights[c] = matrix[c][channel] * change.amount(c);
    }
    return weights;
}

}  // namespace relume::bench
