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

constexpr std::uint64_t kStatingSeed = 0x736b65746368;       // "sketch"
constexpr std::uint64_t kChoosingSeed = 0x63686f6f73696e67;  // "choosing"

// Where a receiver adds to a sketch, and with which sign.
struct SketchPlace {
    std::uint16_t row = 0;
    float sign = 1;
};

// A sketch's rows and where every receiver adds to them.
struct SketchPlan {
    std::uint32_t rows = 0;
    std::vector<SketchPlace> places;

    SketchPlan(std::uint32_t row_count, std::uint64_t seed, std::size_t receivers)
        : rows(row_count), places(receivers) {
        for (std::size_t p = 0; p < receivers; ++p) {
            const std::uint64_t bits = mix_bits(mix_bits(seed) ^ p);
            places[p] = {.row = static_cast<std::uint16_t>((bits >> 1) % rows),
                         .sign = (bits & 1U) != 0 ? 1.0F : -1.0F};
        }
    }

    [[nodiscard]] SketchTable empty_table(std::size_t columns) const {
        return {.scales = std::vector<float>(columns * kColours),
                .values = std::vector<std::int8_t>(columns * kColours * rows)};
    }
};

// The sketch of one column at a time.
class ColumnSketch {
  public:
    explicit ColumnSketch(const SketchPlan& plan)
        : plan_(plan), sums_(kColours * std::size_t{plan.rows}) {}

    void clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }
    void add(std::size_t colour, std::size_t receiver, double value) {
        const SketchPlace& place = plan_.places[receiver];
        sums_[colour * plan_.rows + place.row] += double{place.sign} * value;
    }
    // Rounded to 8 bits, the largest value of each colour to the largest integer: noise of a
    // hundredth of the value, where the estimate itself is good to a twentieth.
    void store(std::size_t column, SketchTable& table) const {
        constexpr double kLargestInteger = std::numeric_limits<std::int8_t>::max();
        const std::size_t rows = plan_.rows;
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::span<const double> sums = std::span(sums_).subspan(c * rows, rows);
            double largest = 0;
            for (const double value : sums) {
                largest = std::max(largest, std::abs(value));
            }
            const std::size_t place = column * kColours + c;
            const auto scale = static_cast<float>(largest / kLargestInteger);
            table.scales[place] = scale;
            for (std::size_t r = 0; r < rows && scale > 0; ++r) {
                table.values[place * rows + r] = static_cast<std::int8_t>(
                    std::clamp(std::round(sums[r] / scale), -kLargestInteger, kLargestInteger));
            }
        }
    }

  private:
    const SketchPlan& plan_;
    std::vector<double> sums_;  // [3][rows]
};

// Sums one column at a time; holds what is reused from column to column.
class ColumnSummer {
  public:
    ColumnSummer(const Manifest& manifest,
                 std::span<const float> steps,
                 std::span<const float> tint,
                 const SketchPlan& stating,
                 const SketchPlan& choosing)
        : manifest_(manifest),
          steps_(steps),
          tint_(tint),
          stating_(stating),
          choosing_(choosing) {}

    void sum(std::size_t column, std::span<const ShardReader> shards) {
        energy_ = {};
        stating_.clear();
        choosing_.clear();
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
        for (std::size_t c = 0; c < kColours; ++c) {
            summary.energies[column * kColours + c] = static_cast<float>(energy_[c]);
        }
        stating_.store(column, summary.stating);
        choosing_.store(column, summary.choosing);
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
                stating_.add(c, first + slot, value);
                choosing_.add(c, first + slot, value);
            }
        }
    }

    const Manifest& manifest_;
    std::span<const float> steps_;
    std::span<const float> tint_;
    ColumnSketch stating_;
    ColumnSketch choosing_;
    std::array<double, kColours> energy_{};
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
    const std::size_t receivers = std::size_t{manifest.block_count()} * kBlockSize;
    const SketchPlan stating(manifest.stating_rows, kStatingSeed, receivers);
    const SketchPlan choosing(manifest.choosing_rows, kChoosingSeed, receivers);
    summary.stating = stating.empty_table(columns);
    summary.choosing = choosing.empty_table(columns);
    constexpr std::size_t kColumnsPerTask = 64;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, columns, kColumnsPerTask),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          ColumnSummer summer(manifest, steps, tint, stating, choosing);
                          for (std::size_t j = range.begin(); j < range.end(); ++j) {
                              summer.sum(j, shards);
                              summer.store(j, summary);
                          }
                      });
    return summary;
}

}  // namespace relume::transport
