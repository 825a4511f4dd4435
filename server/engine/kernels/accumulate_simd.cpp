// The accumulation kernel for every instruction set Highway knows, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/accumulate_simd.cpp"
#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

// Must come after highway.h, in a group of their own so that no formatter sorts them.
#include "server/engine/kernels/block_sums-inl.h"
#include "server/engine/kernels/cell_lists-inl.h"
#include "server/engine/kernels/strip_sums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

void accumulate(std::span<const WeightedSegment> segments,
                std::uint32_t block_count,
                const SumTargets& targets) {
    accumulate_segments_scalar(segments, block_count, targets);
}

#else

namespace {

using transport::CellTag;
using transport::kBlockSize;
using transport::kColours;

// What a thread keeps from call to call; too large for its stack.
class Workspace {
  public:
    void accumulate(std::span<const WeightedSegment> segments,
                    std::uint32_t block_count,
                    const SumTargets& targets) {
        groups_.clear();
        const bool only_one_group = next_group(segments).size() == segments.size();
        while (!segments.empty()) {
            const auto group = next_group(segments);
            lists_.fill(
                group.size(), [&](std::size_t s) { return group[s].segment; }, block_count,
                [&](std::size_t s, std::uint32_t block, const std::uint8_t* cell, float scale)
                    HWY_ATTR { return strips_.add(block, cell, group[s].weights, scale); });
            for (std::uint32_t block = 0; block < block_count; ++block) {
                if (lists_.of_block(block).empty()) {
                    continue;
                }
                take_cells(group, block);
                if (only_one_group) {
                    const std::size_t first = std::size_t{block} * kSumsPerBlock;
                    values_.add_to(strips_.of_block(block), targets.sums + first,
                                   targets.total != nullptr ? targets.total + first : nullptr);
                    strips_.clear(block);
                } else {
                    groups_.add(block, values_);
                }
            }
            segments = segments.subspan(group.size());
        }
        groups_.add_to(targets, [&](std::uint32_t block) { return strips_.of_block(block); });
        for (std::uint32_t block = 0; block < block_count; ++block) {
            if (((groups_.used() >> block) & 1U) == 0) {
                strips_.add_to(block, targets);
            }
            strips_.clear(block);
        }
    }

  private:
    void take_cells(std::span<const WeightedSegment> group, std::uint32_t block) {
        values_.clear();
        for (const ListedCell& listed : lists_.of_block(block)) {
            const ColourWeights& weights = group[listed.segment].weights;
            const std::uint8_t* cell = listed.cell;
            switch (listed.tag) {
                case CellTag::dense8:
                    values_.bits8.add(reinterpret_cast<const std::int8_t*>(cell), weights);
                    break;
                case CellTag::dense16: {
                    std::int16_t* values = aligned16_[values_.bits16.count].data();
                    std::memcpy(values, cell, kBlockSize * sizeof(std::int16_t));
                    values_.bits16.add(values, weights);
                    break;
                }
                case CellTag::dense32f: {
                    transport::DecodedCell& values = decoded_[values_.floats.count];
                    transport::decode_cell(listed.tag, cell, values);
                    values_.floats.add(values.data(), weights);
                    break;
                }
                default:  // lists hold no others
                    break;
            }
        }
    }

    CellLists<kMaxGroupSegments> lists_;
    BlockValues values_;
    GroupSums groups_;
    StripSums strips_;
    // In the order in which they go into values_.
    std::array<std::array<std::int16_t, kBlockSize>, kMaxGroupSegments> aligned16_;
    std::array<transport::DecodedCell, kMaxGroupSegments> decoded_;
};

}  // namespace

void accumulate(std::span<const WeightedSegment> segments,
                std::uint32_t block_count,
                const SumTargets& targets) {
    // On the heap: the address of a thread's own object would be asked for in every loop.
    thread_local const auto workspace = std::make_unique<Workspace>();
    workspace->accumulate(segments, block_count, targets);
}

#endif  // HWY_SCALAR

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {

HWY_EXPORT(accumulate);

void accumulate_segments(std::span<const WeightedSegment> segments,
                         std::uint32_t block_count,
                         const SumTargets& targets) {
    static const bool scalar = scalar_is_forced();
    if (scalar) {
        accumulate_segments_scalar(segments, block_count, targets);
        return;
    }
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(accumulate)(segments, block_count, targets);
}

}  // namespace relume::engine
#endif
