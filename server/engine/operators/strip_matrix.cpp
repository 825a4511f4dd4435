#include "server/engine/operators/strip_matrix.h"

#include "protocol/transport/cell_strips.h"

#include <boost/container/small_vector.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <type_traits>

namespace relume::engine {
namespace {

using transport::CellTag;
using transport::kColours;
using transport::kStripSlots;
using transport::kStripsPerBlock;

// A run's strips hold one part of 8 bits, or floats.
constexpr std::size_t kFloats = transport::kMaxParts;
constexpr std::size_t kKinds = kFloats + 1;
constexpr std::array<float, kKinds> kScales{1, 256, 65536, 1};

}  // namespace

// Arranges the blocks of one shard: counts their strips, then puts them into place.
class StripMatrix::ShardArranger {
  public:
    ShardArranger(StripMatrix& matrix,
                  const transport::ShardReader& reader,
                  std::uint32_t channels)
        : matrix_(matrix),
          reader_(reader),
          channels_(channels),
          strips_(reader.block_count() * runs_per_block() * kStripsPerBlock) {}

    void arrange() {
        for_each_strip([this](std::uint32_t block, std::size_t run, std::size_t place,
                              std::uint16_t /*column*/,
                              const auto& /*values*/) { ++strip(block, run, place); });
        for (std::uint32_t block = 0; block < reader_.block_count(); ++block) {
            begin_runs(block);
        }
        for_each_strip([this](std::uint32_t block, std::size_t run, std::size_t place,
                              std::uint16_t column, const auto& values) {
            Block& target = matrix_.blocks_[reader_.first_block() + block];
            const std::size_t at = strip(block, run, place)++;
            if constexpr (std::is_same_v<decltype(values), const transport::StripValues&>) {
                put(target.parts, at, column, values);
            } else {
                put(target.floats, at, column, values);
            }
        });
    }

  private:
    // Runs a block might have.
    [[nodiscard]] std::size_t runs_per_block() const {
        return matrix_.columns_->band_chunks().size() * channels_ * kKinds;
    }
    // How many strips, and then where the next one goes.
    [[nodiscard]] std::uint32_t& strip(std::uint32_t block,
                                       std::size_t run,
                                       std::size_t place) {
        return strips_[(block * runs_per_block() + run) * kStripsPerBlock + place];
    }

    // Calls visit(block of the shard, run, place, column in its chunk, values).
    template <typename Visit>
    void for_each_strip(const Visit& visit) const {
        for (std::size_t chunk = 0; chunk < matrix_.columns_->band_chunks().size(); ++chunk) {
            const BandChunk& columns = matrix_.columns_->band_chunks()[chunk];
            for (std::size_t place = columns.first; place < columns.last; ++place) {
                for (std::uint32_t k = 0; k < channels_; ++k) {
                    const std::size_t run = (chunk * channels_ + k) * kKinds;
                    for_each_strip_of(
                        reader_.segment(matrix_.columns_->by_band()[place], k),
                        [&](std::uint32_t block, std::size_t kind, std::size_t strip,
                            const auto& values) {
                            visit(block, run + kind, strip,
                                  static_cast<std::uint16_t>(place - columns.first), values);
                        });
                }
            }
        }
    }

    template <typename Visit>
    void for_each_strip_of(const transport::SegmentView& segment, const Visit& visit) const {
        if (segment.empty()) {
            return;
        }
        const std::uint8_t* cell = segment.cells;
        std::uint64_t blocks = segment.occupied_blocks(reader_.block_count());
        for (; blocks != 0; blocks &= blocks - 1) {
            const auto block = static_cast<std::uint32_t>(std::countr_zero(blocks));
            const CellTag tag = segment.tag(block);
            const bool floats = tag == CellTag::dense32f;
            transport::for_each_strip(
                tag, cell, [&](std::size_t part, std::size_t strip, const auto& values) {
                    visit(block, floats ? kFloats : part, strip, values);
                });
            cell += transport::cell_bytes(tag, cell);
        }
    }

    void begin_runs(std::uint32_t number) {
        Block& block = matrix_.blocks_[reader_.first_block() + number];
        std::uint32_t bytes = 0;
        std::uint32_t floats = 0;
        for (std::size_t run = 0; run < runs_per_block(); ++run) {
            const std::size_t kind = run % kKinds;
            std::uint32_t& next = kind == kFloats ? floats : bytes;
            Run begun{.chunk = static_cast<std::uint16_t>(run / kKinds / channels_),
                      .channel = static_cast<std::uint8_t>(run / kKinds % channels_),
                      .kind = static_cast<std::uint8_t>(kind)};
            for (std::size_t place = 0; place < kStripsPerBlock; ++place) {
                begun.begins[place] = next;
                next += strip(number, run, place);
                strip(number, run, place) = begun.begins[place];
            }
            begun.begins[kStripsPerBlock] = next;
            if (next > begun.begins[0]) {
                block.bands |= std::uint32_t{1}
                               << matrix_.columns_->band_chunks()[begun.chunk].band;
                block.runs.push_back(begun);
            }
        }
        block.parts.resize(bytes);
        block.floats.resize(floats);
    }

    template <typename Value>
    static void put(Strips<Value>& strips,
                    std::size_t at,
                    std::uint16_t column,
                    const std::array<Value, kStripSlots>& values) {
        strips.columns[at] = column;
        std::copy(values.begin(), values.end(), &strips.values[kStripSlots * at]);
    }

    StripMatrix& matrix_;
    const transport::ShardReader& reader_;
    std::uint32_t channels_;
    std::vector<std::uint32_t> strips_;  // [blocks][chunks][channels][kinds][places]
};

StripMatrix::StripMatrix(const transport::Transport& transport, const ColumnTable& columns)
    : columns_(&columns), blocks_(transport.manifest().block_count()) {
    tbb::parallel_for(std::size_t{0}, transport.shards().size(), [&](std::size_t shard) {
        ShardArranger(*this, transport.shards()[shard], transport.channel_count()).arrange();
    });
    for (const Block& block : blocks_) {
        bytes_ += block.bytes();
    }
}

void StripMatrix::multiply(std::uint32_t number,
                           std::uint32_t band,
                           std::span<const Member> members) const {
    const Block& block = blocks_[number];
    boost::container::small_vector<StripTarget, 16> targets(members.size());
    for (const Run& run : block.runs) {
        const BandChunk& chunk = columns_->band_chunks()[run.chunk];
        if (chunk.band != band) {
            continue;
        }
        const std::size_t first =
            kWeightsPerColumn * (run.channel * columns_->count() + chunk.first);
        for (std::size_t m = 0; m < members.size(); ++m) {
            targets[m] = {.weights = members[m].weights->data() + first,
                          .sums = members[m].sums};
        }
        const std::span<const StripTarget> all(targets.data(), targets.size());
        if (run.kind == kFloats) {
            multiply_float_strips({.columns = block.floats.columns.data(),
                                   .values = block.floats.values.data(),
                                   .begins = run.begins},
                                  all);
        } else {
            multiply_strips({.columns = block.parts.columns.data(),
                             .values = block.parts.values.data(),
                             .begins = run.begins,
                             .scale = kScales[run.kind]},
                            all);
        }
    }
}

void StripMatrix::set_weights(const transport::Transport& transport,
                              std::span<const float> signal,
                              Weights& weights) const {
    const transport::ColourModel& colour = transport.manifest().colour;
    const std::size_t count = columns_->count();
    weights.resize(kWeightsPerColumn * count * colour.channels);
    for (std::uint32_t k = 0; k < colour.channels; ++k) {
        for (std::size_t place = 0; place < count; ++place) {
            const std::uint32_t column = columns_->by_band()[place];
            const float step = transport.step(column, k);
            float* of_column = &weights[kWeightsPerColumn * (k * count + place)];
            for (std::size_t c = 0; c < kColours; ++c) {
                of_column[c] = step * colour.matrix[c][k] * signal[c * count + column];
            }
        }
    }
}

}  // namespace relume::engine
