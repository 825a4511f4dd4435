#include "protocol/transport/column_summary.h"

#include "protocol/transport/block_basis.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <limits>

namespace relume::transport {
namespace {

constexpr std::uint64_t kStatingSeed = 0x736b65746368;       // "sketch"
constexpr std::uint64_t kChoosingSeed = 0x63686f6f73696e67;  // "choosing"

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
                    block_receivers_from_coefficients(manifest_.block_basis, values[k]);
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
    const SketchPlan stating(manifest.sketch_strata(manifest.stating_rows), kStatingSeed);
    const SketchPlan choosing(manifest.sketch_strata(manifest.choosing_rows), kChoosingSeed);
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
