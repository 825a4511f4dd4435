#include "protocol/transport/column_summary.h"

#include "protocol/transport/error.h"
#include "protocol/transport/hash.h"
#include "protocol/transport/receiver_basis.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace relume::transport {
namespace {

// Where a receiver adds to the sketch, and with which sign.
struct SketchPlace {
    std::uint16_t row = 0;
    float sign = 1;
};

std::vector<SketchPlace> sketch_places(std::size_t receivers, std::uint32_t rows) {
    constexpr std::uint64_t kSketchSeed = 0x736b65746368;  // "sketch"
    std::vector<SketchPlace> places(receivers);
    for (std::size_t p = 0; p < receivers; ++p) {
        const std::uint64_t bits = mix_bits(mix_bits(kSketchSeed) ^ p);
        places[p] = {.row = static_cast<std::uint16_t>((bits >> 1) % rows),
                     .sign = (bits & 1U) != 0 ? 1.0F : -1.0F};
    }
    return places;
}

// Sums one column at a time; holds what is reused from column to column.
class ColumnSummer {
  public:
    ColumnSummer(const Manifest& manifest,
                 std::span<const float> steps,
                 std::span<const float> tint,
                 std::span<const SketchPlace> places)
        : manifest_(manifest),
          steps_(steps),
          tint_(tint),
          places_(places),
          rows_(kColours * std::size_t{manifest.sketch_rows}) {}

    void sum(std::size_t column, std::span<const ShardReader> shards) {
        energy_ = {};
        std::fill(rows_.begin(), rows_.end(), 0.0);
        bytes_ = 0;
        for (const ShardReader& shard : shards) {
            add_shard(column, shard);
        }
    }
    void store(std::size_t column, ColumnSummary& summary) const {
        if (bytes_ > std::numeric_limits<std::uint32_t>::max()) {
            throw TransportError(fmt::format("column {} has {} bytes, expected less than 4 GiB",
                                             column, bytes_));
        }
        summary.column_bytes[column] = static_cast<std::uint32_t>(bytes_);
        const std::size_t rows = manifest_.sketch_rows;
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t place = column * kColours + c;
            summary.energies[place] = static_cast<float>(energy_[c]);
            const std::span<const double> sketch = std::span(rows_).subspan(c * rows, rows);
            double largest = 0;
            for (const double value : sketch) {
                largest = std::max(largest, std::abs(value));
            }
            constexpr double kLargestInteger = std::numeric_limits<std::int16_t>::max();
            const auto scale = static_cast<float>(largest / kLargestInteger);
            summary.sketch_scales[place] = scale;
            for (std::size_t r = 0; r < rows && scale > 0; ++r) {
                summary.sketch_values[place * rows + r] = static_cast<std::int16_t>(std::clamp(
                    std::round(sketch[r] / scale), -kLargestInteger, kLargestInteger));
            }
        }
    }

  private:
    void add_shard(std::size_t column, const ShardReader& shard) {
        const std::uint32_t channels = manifest_.colour.channels;
        std::array<SegmentView, kMaxChannels> segments;
        std::array<const std::uint8_t*, kMaxChannels> cells{};
        bool any = false;
        for (std::uint32_t k = 0; k < channels; ++k) {
            segments[k] = shard.segment(column, k);
            cells[k] = segments[k].cells;
            bytes_ += shard.segment_bytes(column, k);
            any = any || !segments[k].empty();
        }
        for (std::uint32_t block = 0; any && block < shard.block_count(); ++block) {
            std::array<DecodedCell, kMaxChannels> values;
            bool occupied = false;
            for (std::uint32_t k = 0; k < channels; ++k) {
                const CellTag tag =
                    segments[k].empty() ? CellTag::empty : segments[k].tag(block);
                cells[k] = decode_cell(tag, cells[k], values[k]);
                if (tag != CellTag::empty) {
                    block_receivers_from_coefficients(values[k]);
                }
                occupied = occupied || tag != CellTag::empty;
            }
            if (occupied) {
                add_block(column, shard.first_block() + block, values);
            }
        }
    }

    void add_block(std::size_t column,
                   std::uint32_t block,
                   const std::array<DecodedCell, kMaxChannels>& values) {
        const std::uint32_t channels = manifest_.colour.channels;
        const std::size_t first = std::size_t{block} * kBlockSize;
        for (std::size_t c = 0; c < kColours; ++c) {
            double* rows = &rows_[c * manifest_.sketch_rows];
            const float* tint = &tint_[first * kColours + c * kBlockSize];
            for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                double value = 0;
                for (std::uint32_t k = 0; k < channels; ++k) {
                    value += double{manifest_.colour.matrix[c][k]} *
                             double{steps_[column * channels + k]} * double{values[k][slot]};
                }
                if (value == 0) {
                    continue;
                }
                value *= double{tint[slot]};
                energy_[c] += value * value;
                const SketchPlace& place = places_[first + slot];
                rows[place.row] += double{place.sign} * value;
            }
        }
    }

    const Manifest& manifest_;
    std::span<const float> steps_;
    std::span<const float> tint_;
    std::span<const SketchPlace> places_;
    std::array<double, kColours> energy_{};
    std::vector<double> rows_;
    std::uint64_t bytes_ = 0;
};

}  // namespace

ColumnSummary summarise_columns(const Manifest& manifest,
                                std::span<const ShardReader> shards,
                                std::span<const float> steps,
                                std::span<const float> tint) {
    const std::size_t columns = manifest.column_count();
    ColumnSummary summary;
    summary.energies.resize(columns * kColours);
    summary.column_bytes.resize(columns);
    summary.sketch_scales.resize(columns * kColours);
    summary.sketch_values.resize(columns * kColours * manifest.sketch_rows);
    const std::vector<SketchPlace> places =
        sketch_places(std::size_t{manifest.block_count()} * kBlockSize, manifest.sketch_rows);
    constexpr std::size_t kColumnsPerTask = 64;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, columns, kColumnsPerTask),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          ColumnSummer summer(manifest, steps, tint, places);
                          for (std::size_t j = range.begin(); j < range.end(); ++j) {
                              summer.sum(j, shards);
                              summer.store(j, summary);
                          }
                      });
    return summary;
}

}  // namespace relume::transport
