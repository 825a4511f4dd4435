// What cells of strips add up to. Compiled once per instruction set, as Highway's own "-inl"
// headers are.
#if defined(RELUME_STRIP_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_STRIP_SUMS_INL_H
#undef RELUME_STRIP_SUMS_INL_H
#else
#define RELUME_STRIP_SUMS_INL_H
#endif

#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/bitmap_shuffles.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>

// add_one, kSumsPerBlock
#include "server/engine/kernels/block_sums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

namespace hn = hwy::HWY_NAMESPACE;
using transport::kBlockSize;
using transport::kColours;
using transport::kStripSlots;

// What cells of strips add up to, [3][256] a block. Strips in which anything was added are
// remembered, and nothing is done for the others.
class StripSums {
  public:
    // Returns the end of the cell.
    HWY_INLINE const std::uint8_t* add(std::uint32_t block,
                                       const std::uint8_t* cell,
                                       const ColourWeights& weights,
                                       float scale) {
        const hn::CappedTag<float, kStripSlots> df;
        const auto red = hn::Set(df, scale * weights[0]);
        const auto green = hn::Set(df, scale * weights[1]);
        const auto blue = hn::Set(df, scale * weights[2]);
        float* HWY_RESTRICT sums = sums_[block].data();
        const std::uint8_t* strip = cell + 1;
        const std::uint8_t* packed = strip + 2 * std::size_t{cell[0]};
        std::uint32_t touched = 0;
        for (const std::uint8_t* end = packed; strip != end; strip += 2) {
            const unsigned mask = strip[1];
            float* HWY_RESTRICT at = sums + kStripSlots * strip[0];
            touched |= std::uint32_t{1} << strip[0];
            const auto spread = spread_to_slots(packed, mask);
            packed += std::popcount(mask);
            for_each_vector(spread, [&](std::size_t first, auto values) HWY_ATTR {
                const auto add_plane = [&](auto weight, float* HWY_RESTRICT plane) HWY_ATTR {
                    hn::Store(hn::MulAdd(weight, values, hn::Load(df, plane)), df, plane);
                };
                add_plane(red, at + first);
                add_plane(green, at + first + kBlockSize);
                add_plane(blue, at + first + 2 * kBlockSize);
            });
        }
        touched_[block] |= touched;
        return packed;
    }

    // [3][256]; null if nothing was added.
    [[nodiscard]] const float* of_block(std::size_t block) const {
        return touched_[block] != 0 ? sums_[block].data() : nullptr;
    }

    // Adds the block's sums to the targets, if any.
    void add_to(std::size_t block, const SumTargets& targets) const {
        for_each_touched_run(block, [&](std::size_t place) {
            const hn::CappedTag<float, kStripSlots> df;
            const std::size_t first = block * kSumsPerBlock + place;
            for (std::size_t i = 0; i < kStripSlots; i += hn::Lanes(df)) {
                const auto sum = hn::Load(df, &sums_[block][place + i]);
                add_one(df, sum, targets.sums + first + i);
                if (targets.total != nullptr) {
                    add_one(df, sum, targets.total + first + i);
                }
            }
        });
    }

    void clear(std::size_t block) {
        for_each_touched_run(block, [&](std::size_t place) {
            std::fill_n(&sums_[block][place], kStripSlots, 0.0F);
        });
        touched_[block] = 0;
    }

  private:
    using BytesTag = hn::CappedTag<std::uint8_t, kStripSlots>;

    // Packed values to the slots whose bits are set, zero to the others. Reads up to seven
    // bytes beyond the cell: a shard's data has a tail (kShardTailBytes).
    static HWY_INLINE hn::Vec<BytesTag> spread_to_slots(const std::uint8_t* packed,
                                                        unsigned mask) {
        const BytesTag d8;
        return hn::TableLookupBytesOr0(hn::LoadU(d8, packed),
                                       hn::LoadU(d8, kBitmapShuffles[mask].data()));
    }

    // Calls body(first slot, values) for the eight values, in one vector of floats or two.
    template <typename Body>
    static HWY_INLINE void for_each_vector(hn::Vec<BytesTag> spread, const Body& body) {
        for_each_vector_of(hn::CappedTag<float, kStripSlots>(), spread, body);
    }

    // A template by its vectors, for only what such vectors can do has to compile.
    template <typename Floats, typename Body>
    static HWY_INLINE void for_each_vector_of(Floats df,
                                              hn::Vec<BytesTag> spread,
                                              const Body& body) {
        const hn::Rebind<std::int32_t, Floats> d32;
        const hn::Rebind<std::int8_t, Floats> d8;
        if constexpr (hn::MaxLanes(Floats()) == kStripSlots) {
            const auto values = hn::BitCast(hn::CappedTag<std::int8_t, kStripSlots>(), spread);
            body(0, hn::ConvertTo(df, hn::PromoteTo(d32, values)));
        } else {
            alignas(8) std::int8_t values[kStripSlots];
            hn::Store(spread, BytesTag(), reinterpret_cast<std::uint8_t*>(values));
            for (std::size_t first = 0; first < kStripSlots; first += hn::Lanes(df)) {
                body(first,
                     hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d8, values + first))));
            }
        }
    }

    // The places of eight sums each, in every colour.
    template <typename Visit>
    HWY_INLINE void for_each_touched_run(std::size_t block, const Visit& visit) const {
        for (std::uint32_t strips = touched_[block]; strips != 0; strips &= strips - 1) {
            const std::size_t slot =
                kStripSlots * static_cast<std::size_t>(std::countr_zero(strips));
            for (std::size_t c = 0; c < kColours; ++c) {
                visit(c * kBlockSize + slot);
            }
        }
    }

    // Zero between calls.
    alignas(
        64) std::array<std::array<float, kSumsPerBlock>, transport::kMaxBlocksPerShard> sums_{};
    std::array<std::uint32_t, transport::kMaxBlocksPerShard> touched_{};
};

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
