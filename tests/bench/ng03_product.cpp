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

void Ng03Columns::append(const transport::ShardReader& reader,
                         std::size_t position,
                         Shard& shard) const {
    std::vector<std::vector<Entry>> digits;
    std::uint32_t current = 0;
    const auto flush = [&] {
        float scale = columns_->scale(position);
        for (std::vector<Entry>& entries : digits) {
            if (!entries.empty()) {
                shard.runs.push_back(
                    {current, static_cast<std::uint32_t>(entries.size()), scale});
                for (const Entry& entry : entries) {
                    shard.slots.push_back(entry.slot);
                    shard.values.push_back(entry.value);
                }
            }
            entries.clear();
            scale *= kDigit;
        }
    };
    columns_->for_each_entry(reader, position, [&](const SparseEntry& entry) {
        if (entry.block != current) {
            flush();
            current = entry.block;
        }
        append_digits(entry.integer, entry.slot, digits);
    });
    flush();
    shard.first_runs.push_back(shard.runs.size());
    shard.first_entries.push_back(shard.values.size());
}

Ng03Columns::Ng03Columns(const SparseColumns& columns)
    : columns_(&columns), shards_(columns.scene().transport().shards().size()) {
    tbb::parallel_for(std::size_t{0}, shards_.size(), [&](std::size_t s) {
        for (std::size_t position = 0; position < columns.size(); ++position) {
            append(columns.scene().transport().shards()[s], position, shards_[s]);
        }
    });
    for (const Shard& shard : shards_) {
        count(shard);
    }
}

void Ng03Columns::count(const Shard& shard) {
    entries_ += shard.values.size();
    bytes_ += shard.runs.size() * sizeof(Run) + shard.slots.size() + shard.values.size();
    for (std::size_t position = 0; position < columns_->size(); ++position) {
        for (std::size_t r = shard.first_runs[position]; r < shard.first_runs[position + 1];
             ++r) {
            const Run& run = shard.runs[r];
            extra_entries_ += run.scale > columns_->scale(position) ? run.count : 0;
        }
    }
}

Ng03Product::Ng03Product(const Ng03Columns& columns)
    : columns_(&columns), image_(columns.columns_->scene().stored_operator().sum_count()) {}

void Ng03Product::add_column(const Ng03Columns::Shard& shard,
                             std::size_t position,
                             const Weights& weights,
                             float* image) {
    const std::uint8_t* slots = shard.slots.data() + shard.first_entries[position];
    const std::int8_t* values = shard.values.data() + shard.first_entries[position];
    for (std::size_t r = shard.first_runs[position]; r < shard.first_runs[position + 1]; ++r) {
        const Ng03Columns::Run& run = shard.runs[r];
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
    const SparseColumns& index = *columns_->columns_;
    const auto& shards = index.scene().transport().shards();
    tbb::parallel_for(std::size_t{0}, shards.size(), [&](std::size_t s) {
        float* image = &image_[std::size_t{shards[s].first_block()} * kBlockSize * kColours];
        for (const engine::ColumnChange& change : changes) {
            const std::size_t position = index.position(change.column);
            for (std::uint32_t k = 0; k < index.channels(); ++k) {
                add_column(columns_->shards_[s], position + k,
                           channel_weights(index.scene(), change, k), image);
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
