#include "tests/bench/ng03_product.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace relume::bench {
namespace {

using transport::kBlockSize;
using transport::kColours;

constexpr std::int32_t kDigit = 256;

struct Entry {
    std::uint8_t slot;
    std::int8_t value;
};

// Digits of base 256, each in [−128, 127], least first; entries[d] gets those that are not 0.
void append_digits(std::int32_t value,
                   std::uint32_t slot,
                   std::vector<std::vector<Entry>>& entries) {
    for (std::size_t digit = 0; value != 0; ++digit) {
        const auto low = static_cast<std::int8_t>(static_cast<std::uint8_t>(value & 0xFF));
        value = (value - low) / kDigit;
        if (entries.size() <= digit) {
            entries.emplace_back();
        }
        if (low != 0) {
            entries[digit].push_back({static_cast<std::uint8_t>(slot), low});
        }
    }
}

}  // namespace

Ng03Columns::Column Ng03Columns::encode(const transport::ShardReader& shard,
                                        std::uint32_t column,
                                        std::uint32_t channel,
                                        float step) {
    Column encoded;
    std::vector<std::vector<Entry>> digits;
    std::uint32_t current = 0;
    const auto flush = [&] {
        float scale = step;
        for (std::vector<Entry>& entries : digits) {
            if (!entries.empty()) {
                encoded.runs.push_back(
                    {current, static_cast<std::uint32_t>(entries.size()), scale});
                for (const Entry& entry : entries) {
                    encoded.slots.push_back(entry.slot);
                    encoded.values.push_back(entry.value);
                }
            }
            entries.clear();
            scale *= kDigit;
        }
    };
    for_each_value(
        shard, column, channel, [&](std::uint32_t block, std::uint32_t slot, float value) {
            if (block != current) {
                flush();
                current = block;
            }
            append_digits(static_cast<std::int32_t>(std::lround(value)), slot, digits);
        });
    flush();
    return encoded;
}

Ng03Columns::Ng03Columns(const engine::Scene& scene, std::span<const std::uint32_t> columns)
    : scene_(&scene), index_(columns, scene.transport().channel_count()) {
    for (const auto& reader : scene.transport().shards()) {
        Shard shard{.first_block = reader.first_block(),
                    .block_count = reader.block_count(),
                    .columns = {}};
        for (const std::uint32_t j : columns) {
            for (std::uint32_t k = 0; k < index_.channels(); ++k) {
                Column column = encode(reader, j, k, scene.transport().step(j, k));
                entries_ += column.values.size();
                for (const Run& run : column.runs) {
                    extra_entries_ += run.scale > scene.transport().step(j, k) ? run.count : 0;
                }
                shard.columns.push_back(std::move(column));
            }
        }
        shards_.push_back(std::move(shard));
    }
}

Ng03Product::Ng03Product(const Ng03Columns& columns)
    : columns_(&columns), image_(columns.scene_->sum_count()) {}

void Ng03Product::add_column(const Ng03Columns::Column& column,
                             const Weights& weights,
                             float* image) {
    const std::uint8_t* slots = column.slots.data();
    const std::int8_t* values = column.values.data();
    for (const Ng03Columns::Run& run : column.runs) {
        const float red = weights[0] * run.scale;
        const float green = weights[1] * run.scale;
        const float blue = weights[2] * run.scale;
        float* block = image + std::size_t{run.block} * kBlockSize * kColours;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const auto value = static_cast<float>(values[i]);
            float* pixel = block + std::size_t{slots[i]} * kColours;
            pixel[0] += red * value;
            pixel[1] += green * value;
            pixel[2] += blue * value;
        }
        slots += run.count;
        values += run.count;
    }
}

void Ng03Product::add(std::span<const engine::ColumnChange> changes) {
    const std::uint32_t channels = columns_->index_.channels();
    tbb::parallel_for(std::size_t{0}, columns_->shards_.size(), [&](std::size_t s) {
        const Ng03Columns::Shard& shard = columns_->shards_[s];
        float* image = &image_[std::size_t{shard.first_block} * kBlockSize * kColours];
        for (const engine::ColumnChange& change : changes) {
            const std::size_t position = columns_->index_.position(change.column) * channels;
            for (std::uint32_t k = 0; k < channels; ++k) {
                add_column(shard.columns[position + k],
                           channel_weights(*columns_->scene_, change, k), image);
            }
        }
    });
}

std::vector<float> Ng03Product::sums() const {
    std::vector<float> sums;
    sums.reserve(image_.size());
    constexpr std::size_t kBlockSums = std::size_t{kBlockSize} * kColours;
    for (std::size_t block = 0; block < image_.size(); block += kBlockSums) {
        for (std::size_t c = 0; c < kColours; ++c) {
            for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                sums.push_back(image_[block + slot * kColours + c]);
            }
        }
    }
    return sums;
}

}  // namespace relume::bench
