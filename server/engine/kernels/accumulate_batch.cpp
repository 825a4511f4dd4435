// The batch kernel for every instruction set Highway knows, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/accumulate_batch.cpp"
#include "server/engine/kernels/accumulate_batch.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

// Must come after highway.h, in a group of their own so that no formatter sorts them.
#include "server/engine/kernels/batch_lanes-inl.h"
#include "server/engine/kernels/cell_lists-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

void accumulate_members(std::span<const BatchMember> members, std::uint32_t block_count) {
    accumulate_batch_scalar(members, block_count);
}

#else

namespace {

using transport::CellTag;
using transport::kBlockSize;

// Groups of all members that are taken together: every segment once, with the weights of all
// who take it. A round is the next group of every member; a wave holds as many rounds as make
// it worth while to go through the members' sums.
class Wave {
  public:
    static constexpr std::size_t kMaxRound = kMaxBatchMembers * kMaxGroupSegments;
    static constexpr std::size_t kEnough = 2048;  // segments
    static constexpr std::size_t kMaxSegments = kEnough + kMaxRound;

    // False when no member has anything left.
    bool fill(std::span<std::span<const WeightedSegment>> left) {
        segments_.clear();
        weights_.clear();
        for (std::uint16_t round = 0; segments_.size() < kEnough && take_round(left, round);
             ++round) {
        }
        return !segments_.empty();
    }

    struct Lanes {
        LaneWeights weights{};
        std::array<std::uint8_t, kMaxVectors> active{};  // vectors with a weight, ascending
        std::uint8_t active_count = 0;
        std::uint16_t round = 0;
    };

    [[nodiscard]] std::span<const transport::SegmentView> segments() const { return segments_; }
    [[nodiscard]] const Lanes& lanes(std::size_t segment) const { return weights_[segment]; }

  private:
    using Groups = std::array<std::span<const WeightedSegment>, kMaxBatchMembers>;

    // Those groups whose stretch comes first, so that members keep in step.
    bool take_round(std::span<std::span<const WeightedSegment>> left, std::uint16_t round) {
        auto stretch = std::numeric_limits<std::uint32_t>::max();
        for (const auto& segments : left) {
            stretch = segments.empty() ? stretch : std::min(stretch, segments.front().stretch);
        }
        for (std::size_t m = 0; m < left.size(); ++m) {
            const bool takes_part = !left[m].empty() && left[m].front().stretch == stretch;
            groups_[m] = takes_part ? next_group(left[m]) : left[m].first(0);
            left[m] = left[m].subspan(groups_[m].size());
        }
        const std::size_t before = segments_.size();
        while (take_next(std::span(groups_).first(left.size()), round)) {
        }
        return segments_.size() > before;
    }

    // The first in memory of what is left of the groups.
    bool take_next(std::span<std::span<const WeightedSegment>> groups, std::uint16_t round) {
        const std::uint8_t* first = nullptr;
        for (const auto& group : groups) {
            if (!group.empty() && (first == nullptr || group.front().segment.tags < first)) {
                first = group.front().segment.tags;
            }
        }
        if (first == nullptr) {
            return false;
        }
        Lanes& lanes = weights_.emplace_back();
        lanes.round = round;
        for (std::size_t m = 0; m < groups.size(); ++m) {
            if (groups[m].empty() || groups[m].front().segment.tags != first) {
                continue;
            }
            if (segments_.size() < weights_.size()) {
                segments_.push_back(groups[m].front().segment);
            }
            std::copy_n(groups[m].front().weights.begin(), transport::kColours,
                        &lanes.weights[transport::kColours * m]);
            groups[m] = groups[m].subspan(1);
        }
        note_active(lanes);
        return true;
    }

    static void note_active(Lanes& lanes) {
        for (std::size_t vector = 0; vector < kMaxVectors; ++vector) {
            const auto first =
                lanes.weights.begin() + static_cast<std::ptrdiff_t>(vector * kVectorLanes);
            if (std::any_of(first, first + kVectorLanes,
                            [](float weight) { return weight != 0; })) {
                lanes.active[lanes.active_count++] = static_cast<std::uint8_t>(vector);
            }
        }
    }

    Groups groups_;
    std::vector<transport::SegmentView> segments_;
    std::vector<Lanes> weights_;
};

// Every value of a byte, so that it need not be converted.
constexpr std::array<float, 256> kFloatFromByte = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<float>(static_cast<std::int8_t>(i));
    }
    return values;
}();

// A bit for every slot of a block.
using Bitmap = std::array<std::uint8_t, kBlockSize / 8>;

// Calls add(slot) for every set bit of a bitmap.
template <typename Add>
HWY_INLINE void for_each_slot(const Bitmap& bitmap, const Add& add) {
    for (std::size_t first = 0; first < kBlockSize; first += 64) {
        std::uint64_t mask = 0;
        std::memcpy(&mask, &bitmap[first / 8], sizeof(mask));
        for (; mask != 0; mask &= mask - 1) {
            add(first + static_cast<std::size_t>(std::countr_zero(mask)));
        }
    }
}

// Bit i: byte i of a dense cell is not zero.
Bitmap occupancy(const std::uint8_t* cell) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<std::uint8_t, 64> d8;
    Bitmap bits;
    for (std::size_t slot = 0; slot < kBlockSize; slot += hn::Lanes(d8)) {
        hn::StoreMaskBits(d8, hn::Ne(hn::LoadU(d8, cell + slot), hn::Zero(d8)),
                          &bits[slot / 8]);
    }
    return bits;
}

std::uint32_t rows_of_bitmap(const Bitmap& bitmap) {
    std::uint32_t rows = 0;
    for (std::size_t row = 0; row < kBlockSize / LaneSums::kRowSlots; ++row) {
        rows |= ((bitmap[2 * row] | bitmap[2 * row + 1]) != 0 ? 1U : 0U) << row;
    }
    return rows;
}

// The cells of strips of one block. Alone a session adds them on the way, but sixteen sessions'
// sums of a whole shard would not stay in any near cache.
class StripCells {
  public:
    struct Cell {
        const std::uint8_t* cell;
        float scale;
        std::uint16_t segment;  // in its wave
    };

    // Returns the end of the cell.
    HWY_INLINE const std::uint8_t* add(std::size_t segment,
                                       const std::uint8_t* cell,
                                       float scale) {
        cells_.push_back({cell, scale, static_cast<std::uint16_t>(segment)});
        const std::size_t count = cell[0];
        const std::uint8_t* packed = cell + 1 + 2 * count;
        for (std::size_t i = 0; i < count; ++i) {
            packed += std::popcount(cell[2 + 2 * i]);
        }
        return packed;
    }
    [[nodiscard]] std::span<const Cell> all() const { return cells_; }
    void clear() { cells_.clear(); }

  private:
    std::vector<Cell> cells_;
};

constexpr std::uint32_t kAllRows = (1U << (kBlockSize / LaneSums::kRowSlots)) - 1;

// What a thread keeps from call to call; too large for its stack.
class Workspace {
  public:
    void accumulate(std::span<const BatchMember> members, std::uint32_t block_count) {
        members_ = members;
        const std::size_t lanes = transport::kColours * members.size();
        stride_ = (lanes + kVectorLanes - 1) / kVectorLanes * kVectorLanes;
        std::array<std::span<const WeightedSegment>, kMaxBatchMembers> left;
        std::transform(members.begin(), members.end(), left.begin(),
                       [](const BatchMember& member) { return member.segments; });
        while (wave_.fill(std::span(left).first(members.size()))) {
            const auto segments = wave_.segments();
            lists_.fill(
                segments.size(), [&](std::size_t s) { return segments[s]; }, block_count,
                [&](std::size_t s, std::uint32_t block, const std::uint8_t* cell, float scale)
                    HWY_ATTR { return strip_cells_[block].add(s, cell, scale); });
            for (std::uint32_t block = 0; block < block_count; ++block) {
                take_cells(block);
                take_strips(block);
            }
        }
        for (std::uint32_t block = 0; block < block_count; ++block) {
            values_[block].absorb(strips_[block], stride_);
            values_[block].take(members, block, stride_);
        }
    }

  private:
    using Lists = CellLists<Wave::kMaxSegments>;

    // In the order of the contract: of each round first the cells of 8 bits, then of 16, then
    // floats.
    void take_cells(std::uint32_t block) {
        std::uint16_t round = 0;
        for (const ListedCell& listed : lists_.of_block(block)) {
            const Wave::Lanes& lanes = wave_.lanes(listed.segment);
            if (lanes.round != round) {
                add_wide(block);
                round = lanes.round;
            }
            switch (listed.tag) {
                case CellTag::dense8:
                    add_dense8(block, listed.cell, lanes);
                    break;
                default:
                    wide_.push_back(listed);
                    break;
            }
        }
        add_wide(block);
    }

    void take_strips(std::uint32_t block) {
        const std::span<const StripCells::Cell> cells = strip_cells_[block].all();
        for (std::size_t i = 0; i < cells.size(); ++i) {
            // In the order of blocks, memory is gone through in leaps.
            constexpr std::size_t kAhead = 8;
            __builtin_prefetch(cells[std::min(i + kAhead, cells.size() - 1)].cell);
            add_strips(block, cells[i].cell, wave_.lanes(cells[i].segment), cells[i].scale);
        }
        strip_cells_[block].clear();
    }

    void add_strips(std::uint32_t block,
                    const std::uint8_t* cell,
                    const Wave::Lanes& lanes,
                    float scale) {
        const std::size_t count = cell[0];
        const std::uint8_t* packed = cell + 1 + 2 * count;
        LaneSums& sums = strips_[block];
        const std::size_t stride = stride_;
        with_active_lanes(
            lanes.weights, lanes.active, lanes.active_count, scale,
            [&](const auto& active) HWY_ATTR {
                for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t first = transport::kStripSlots * cell[1 + 2 * i];
                    sums.touch_row_of(first);
                    for (unsigned mask = cell[2 + 2 * i]; mask != 0; mask &= mask - 1) {
                        const auto slot =
                            first + static_cast<std::size_t>(std::countr_zero(mask));
                        active.add(kFloatFromByte[*packed++], sums.slot(slot, stride));
                    }
                }
            });
    }

    // Many values are zero, and to pass one over is cheaper than to add it to so many lanes.
    void add_dense8(std::uint32_t block, const std::uint8_t* cell, const Wave::Lanes& lanes) {
        const auto occupied = occupancy(cell);
        LaneSums& sums = values_[block];
        const std::size_t stride = stride_;
        sums.touch_rows(rows_of_bitmap(occupied));
        with_active_lanes(lanes.weights, lanes.active, lanes.active_count, 1,
                          [&](const auto& active) HWY_ATTR {
                              for_each_slot(occupied, [&](std::size_t slot) HWY_ATTR {
                                  active.add(kFloatFromByte[cell[slot]],
                                             sums.slot(slot, stride));
                              });
                          });
    }

    // What was put aside of a round: rare, and decoded as the specification does.
    void add_wide(std::uint32_t block) {
        for (const bool floats : {false, true}) {
            for (const ListedCell& listed : wide_) {
                if ((listed.tag == CellTag::dense32f) != floats) {
                    continue;
                }
                transport::DecodedCell values;
                transport::decode_cell(listed.tag, listed.cell, values);
                const Wave::Lanes& lanes = wave_.lanes(listed.segment);
                LaneSums& sums = values_[block];
                sums.touch_rows(kAllRows);
                with_active_lanes(lanes.weights, lanes.active, lanes.active_count, 1,
                                  [&](const auto& active) HWY_ATTR {
                                      for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                                          active.add(values[slot], sums.slot(slot, stride_));
                                      }
                                  });
            }
        }
        wide_.clear();
    }

    std::span<const BatchMember> members_;
    std::size_t stride_ = 0;
    Wave wave_;
    Lists lists_;
    std::vector<ListedCell> wide_;
    std::array<StripCells, transport::kMaxBlocksPerShard> strip_cells_;
    std::array<LaneSums, transport::kMaxBlocksPerShard> values_;
    std::array<LaneSums, transport::kMaxBlocksPerShard> strips_;
};

}  // namespace

void accumulate_members(std::span<const BatchMember> members, std::uint32_t block_count) {
    thread_local const auto workspace = std::make_unique<Workspace>();
    workspace->accumulate(members, block_count);
}

#endif  // HWY_SCALAR

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {

HWY_EXPORT(accumulate_members);

void accumulate_batch_scalar(std::span<const BatchMember> members, std::uint32_t block_count) {
    for (const BatchMember& member : members) {
        accumulate_segments_scalar(member.segments, block_count, member.targets);
    }
}

void accumulate_batch(std::span<const BatchMember> members, std::uint32_t block_count) {
    static const bool scalar = scalar_is_forced();
    if (scalar) {
        accumulate_batch_scalar(members, block_count);
        return;
    }
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(accumulate_members)(members, block_count);
}

}  // namespace relume::engine
#endif
