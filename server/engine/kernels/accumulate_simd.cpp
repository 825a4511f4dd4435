// The accumulation kernel for every instruction set Highway knows, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/accumulate_simd.cpp"
#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/bitmap_shuffles.h"
#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using transport::CellTag;
using transport::kBitmapBytes;
using transport::kBlockSize;
using transport::kColours;

using ExpandedCell = std::array<std::int8_t, kBlockSize>;

// The 8-bit cells of one block that are added together: at most one per segment.
struct DenseCells {
    std::array<const std::int8_t*, kSegmentGroup> values{};
    std::array<const ColourWeights*, kSegmentGroup> weights{};
    std::size_t count = 0;

    void add(const std::int8_t* cell, const ColourWeights& cell_weights) {
        values[count] = cell;
        weights[count] = &cell_weights;
        ++count;
    }
};

// Sums of 256 slots × 3 colours pass through registers once for all cells.
void add_dense(const DenseCells& cells, float* HWY_RESTRICT sums) {
    const hn::CappedTag<float, 16> df;
    const hn::Rebind<std::int32_t, decltype(df)> d32;
    const hn::Rebind<std::int8_t, decltype(df)> d8;
    const std::size_t lanes = hn::Lanes(df);
    float* HWY_RESTRICT red = sums;
    float* HWY_RESTRICT green = sums + kBlockSize;
    float* HWY_RESTRICT blue = sums + 2 * kBlockSize;
    for (std::size_t i = 0; i < kBlockSize; i += 2 * lanes) {
        auto r0 = hn::LoadU(df, red + i);
        auto g0 = hn::LoadU(df, green + i);
        auto b0 = hn::LoadU(df, blue + i);
        auto r1 = hn::LoadU(df, red + i + lanes);
        auto g1 = hn::LoadU(df, green + i + lanes);
        auto b1 = hn::LoadU(df, blue + i + lanes);
        for (std::size_t s = 0; s < cells.count; ++s) {
            const std::int8_t* HWY_RESTRICT values = cells.values[s] + i;
            const float* HWY_RESTRICT weights = cells.weights[s]->data();
            const auto v0 = hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d8, values)));
            const auto v1 =
                hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d8, values + lanes)));
            const auto wr = hn::Set(df, weights[0]);
            const auto wg = hn::Set(df, weights[1]);
            const auto wb = hn::Set(df, weights[2]);
            r0 = hn::Add(r0, hn::Mul(wr, v0));
            g0 = hn::Add(g0, hn::Mul(wg, v0));
            b0 = hn::Add(b0, hn::Mul(wb, v0));
            r1 = hn::Add(r1, hn::Mul(wr, v1));
            g1 = hn::Add(g1, hn::Mul(wg, v1));
            b1 = hn::Add(b1, hn::Mul(wb, v1));
        }
        hn::StoreU(r0, df, red + i);
        hn::StoreU(g0, df, green + i);
        hn::StoreU(b0, df, blue + i);
        hn::StoreU(r1, df, red + i + lanes);
        hn::StoreU(g1, df, green + i + lanes);
        hn::StoreU(b1, df, blue + i + lanes);
    }
}

// Spreads packed 8-bit values to the slots whose bits are set, eight slots a step by table.
// Reads up to eight bytes beyond the cell: a shard's data has a tail (kShardTailBytes).
void expand_bitmap8(const std::uint8_t* cell, ExpandedCell& values) {
    auto* out = reinterpret_cast<std::uint8_t*>(values.data());
    const std::uint8_t* packed = cell + kBitmapBytes;
    for (std::size_t byte = 0; byte < kBitmapBytes; ++byte, out += 8) {
        const std::uint8_t mask = cell[byte];
#if HWY_TARGET == HWY_SCALAR
        for (std::size_t bit = 0; bit < 8; ++bit) {
            const std::uint8_t place = kBitmapShuffles[mask][bit];
            out[bit] = place < 8 ? packed[place] : 0;
        }
#else
        const hn::CappedTag<std::uint8_t, 8> d8;
        const auto places = hn::LoadU(d8, kBitmapShuffles[mask].data());
        hn::StoreU(hn::TableLookupBytesOr0(hn::LoadU(d8, packed), places), d8, out);
#endif
        packed += std::popcount(mask);
    }
}

// 16-bit and float cells are rare: decoded, then added one at a time.
void add_wide(CellTag tag,
              const std::uint8_t* cell,
              const ColourWeights& weights,
              float* HWY_RESTRICT sums) {
    const hn::CappedTag<float, 16> df;
    transport::DecodedCell values;
    transport::decode_cell(tag, cell, values);
    for (std::size_t c = 0; c < kColours; ++c) {
        const auto weight = hn::Set(df, weights[c]);
        float* colour = sums + c * kBlockSize;
        for (std::size_t i = 0; i < kBlockSize; i += hn::Lanes(df)) {
            const auto product = hn::Mul(weight, hn::LoadU(df, &values[i]));
            hn::StoreU(hn::Add(hn::LoadU(df, colour + i), product), df, colour + i);
        }
    }
}

void add_sparse(const std::uint8_t* cell, const ColourWeights& weights, float* sums) {
    const std::size_t count = cell[0];
    const std::uint8_t* slots = cell + 1;
    const std::uint8_t* values = slots + count;
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = static_cast<float>(static_cast<std::int8_t>(values[i]));
        float* slot = sums + slots[i];
        slot[0] += weights[0] * value;
        slot[kBlockSize] += weights[1] * value;
        slot[2 * kBlockSize] += weights[2] * value;
    }
}

// One group of segments, cell by cell.
class Group {
  public:
    explicit Group(std::span<const WeightedSegment> segments) : segments_(segments) {
        for (std::size_t s = 0; s < segments.size(); ++s) {
            cells_[s] = segments[s].segment.cells;
        }
    }

    void add_block(std::uint32_t block, float* sums) {
        DenseCells dense;
        std::array<const std::uint8_t*, kSegmentGroup> sparse{};
        std::array<const ColourWeights*, kSegmentGroup> sparse_weights{};
        std::size_t sparse_count = 0;
        for (std::size_t s = 0; s < segments_.size(); ++s) {
            const WeightedSegment& segment = segments_[s];
            const std::uint8_t* cell = cells_[s];
            const CellTag tag = segment.segment.tag(block);
            switch (tag) {
                case CellTag::empty:
                    continue;
                case CellTag::dense8:
                    dense.add(reinterpret_cast<const std::int8_t*>(cell), segment.weights);
                    break;
                case CellTag::bitmap8:
                    expand_bitmap8(cell, expanded_[s]);
                    dense.add(expanded_[s].data(), segment.weights);
                    break;
                case CellTag::sparse8:
                    sparse[sparse_count] = cell;
                    sparse_weights[sparse_count++] = &segment.weights;
                    break;
                default:
                    // Keeps the order of additions: what came before goes in first.
                    add_dense(dense, sums);
                    dense.count = 0;
                    add_wide(tag, cell, segment.weights, sums);
                    break;
            }
            cells_[s] = cell + transport::cell_bytes(tag, cell);
        }
        if (dense.count != 0) {
            add_dense(dense, sums);
        }
        for (std::size_t s = 0; s < sparse_count; ++s) {
            add_sparse(sparse[s], *sparse_weights[s], sums);
        }
    }

  private:
    std::span<const WeightedSegment> segments_;
    std::array<const std::uint8_t*, kSegmentGroup> cells_{};
    std::array<ExpandedCell, kSegmentGroup> expanded_;
};

}  // namespace

void accumulate(std::span<const WeightedSegment> segments,
                std::uint32_t block_count,
                float* sums) {
    for (std::size_t first = 0; first < segments.size(); first += kSegmentGroup) {
        Group group(segments.subspan(first, std::min(kSegmentGroup, segments.size() - first)));
        for (std::uint32_t block = 0; block < block_count; ++block) {
            group.add_block(block, sums + std::size_t{block} * kColours * kBlockSize);
        }
    }
}

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {

HWY_EXPORT(accumulate);

void accumulate_segments(std::span<const WeightedSegment> segments,
                         std::uint32_t block_count,
                         float* sums) {
    static const bool scalar = scalar_is_forced();
    if (scalar) {
        accumulate_segments_scalar(segments, block_count, sums);
        return;
    }
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(accumulate)(segments, block_count, sums);
}

}  // namespace relume::engine
#endif
