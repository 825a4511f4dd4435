// The accumulation kernel for every instruction set Highway knows, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/accumulate_simd.cpp"
#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <memory>

// Must come after highway.h, in a group of their own so that no formatter sorts them.
#include "server/engine/kernels/cell_lists-inl.h"
#include "server/engine/kernels/dense_sums-inl.h"
#include "server/engine/kernels/packed_sums-inl.h"

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

// What a thread keeps from call to call; too large for its stack.
class Workspace {
  public:
    void accumulate(std::span<const WeightedSegment> segments,
                    std::uint32_t block_count,
                    const SumTargets& targets) {
        packed_.clear();
        while (!segments.empty()) {
            const auto group = next_group(segments);
            lists_.fill(
                group.size(), [&](std::size_t s) { return group[s].segment; }, block_count);
            for (std::uint32_t block = 0; block < block_count; ++block) {
                take_cells(group, block);
                const std::size_t first =
                    std::size_t{block} * transport::kColours * transport::kBlockSize;
                dense_.add_to(targets.sums + first,
                              targets.total != nullptr ? targets.total + first : nullptr);
            }
            segments = segments.subspan(group.size());
        }
        packed_.add_to(targets);
    }

  private:
    // Packed cells are added to their sums, the others go into dense_.
    void take_cells(std::span<const WeightedSegment> group, std::uint32_t block) {
        dense_.clear();
        for (const ListedCell& listed : lists_.of_block(block)) {
            const ColourWeights& weights = group[listed.segment].weights;
            const std::uint8_t* cell = listed.cell;
            CellTag tag = listed.tag;
            if (transport::is_split(tag)) {
                packed_.add(block, CellTag::sparse8, cell, weights, transport::kHighPart);
                cell += transport::cell_bytes(CellTag::sparse8, cell);
                tag = transport::low_tag(tag);
            }
            switch (tag) {
                case CellTag::sparse8:
                case CellTag::bitmap8:
                case CellTag::bitmap16:
                    packed_.add(block, tag, cell, weights, 1);
                    break;
                case CellTag::dense8:
                    dense_.bits8.add(cell, weights);
                    break;
                case CellTag::dense16:
                    dense_.bits16.add(cell, weights);
                    break;
                case CellTag::dense32f:
                    dense_.floats.add(cell, weights);
                    break;
                default:  // lists hold no empty cells
                    break;
            }
        }
    }

    CellLists<kMaxGroupSegments> lists_;
    DenseSums dense_;
    PackedSums packed_;
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
