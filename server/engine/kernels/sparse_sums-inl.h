// What sparse cells add up to. Compiled once per instruction set,
// as Highway's own "-inl" headers are.
#if defined(RELUME_SPARSE_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_SPARSE_SUMS_INL_H
#undef RELUME_SPARSE_SUMS_INL_H
#else
#define RELUME_SPARSE_SUMS_INL_H
#endif

#include "server/engine/kernels/accumulate.h"

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

// What sparse cells add up to, colours side by side so that a value is one addition; by block.
// Most cells hold a few of the coarsest coefficients: rows of 16 slots in which anything was
// added are remembered, and nothing is done for the others.
class SparseSums {
  public:
    HWY_INLINE void add(std::uint32_t block,
                        const std::uint8_t* cell,
                        const ColourWeights& weights,
                        float scale) {
        const hn::FixedTag<float, 4> d4;
        float* HWY_RESTRICT sums = sums_[block].data();
        const std::array<float, 4> padded{weights[0], weights[1], weights[2], 0};
        const auto w = hn::Mul(hn::Set(d4, scale), hn::LoadU(d4, padded.data()));
        const std::size_t count = cell[0];
        const std::uint8_t* slots = cell + 1;
        const auto* values = reinterpret_cast<const std::int8_t*>(slots + count);
        std::uint32_t rows = 0;
        for (std::size_t i = 0; i < count; ++i) {
            rows |= std::uint32_t{1} << (slots[i] / kRowSlots);
            float* slot = sums + std::size_t{4} * slots[i];
            const auto value = hn::Set(d4, static_cast<float>(values[i]));
            hn::Store(hn::MulAdd(w, value, hn::Load(d4, slot)), d4, slot);
        }
        touched_rows_[block] |= rows;
    }

    // Adds the sums of the first `block_count` blocks to the targets, and is zero again.
    void take(std::uint32_t block_count, const SumTargets& targets) {
        for (std::size_t block = 0; block < block_count; ++block) {
            for (std::uint32_t rows = touched_rows_[block]; rows != 0; rows &= rows - 1) {
                const std::size_t slot =
                    kRowSlots * static_cast<std::size_t>(std::countr_zero(rows));
                float* from = &sums_[block][4 * slot];
                const std::size_t first = block * kSumsPerBlock + slot;
                add_row(from, targets.sums + first);
                if (targets.total != nullptr) {
                    add_row(from, targets.total + first);
                }
                std::fill_n(from, 4 * kRowSlots, 0.0F);
            }
            touched_rows_[block] = 0;
        }
    }

  private:
    static constexpr std::size_t kRowSlots = 16;

    static HWY_INLINE void add_row(const float* HWY_RESTRICT sums, float* HWY_RESTRICT target) {
        const hn::FixedTag<float, 4> d4;
        for (std::size_t slot = 0; slot < kRowSlots; slot += 4) {
            hn::Vec<decltype(d4)> red, green, blue, unused;
            hn::LoadInterleaved4(d4, sums + 4 * slot, red, green, blue, unused);
            add_one(d4, red, target + slot);
            add_one(d4, green, target + kBlockSize + slot);
            add_one(d4, blue, target + 2 * kBlockSize + slot);
        }
    }

    // Zero between calls.
    alignas(64)
        std::array<std::array<float, 4 * kBlockSize>, transport::kMaxBlocksPerShard> sums_{};
    std::array<std::uint32_t, transport::kMaxBlocksPerShard> touched_rows_{};
};

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
