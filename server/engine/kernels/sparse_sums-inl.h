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

// What sparse cells add up to, colours side by side so that a value is one addition; by block,
// zero until the block's first sparse cell.
class SparseSums {
  public:
    void clear() { used_ = 0; }

    HWY_INLINE void add(std::uint32_t block,
                        const std::uint8_t* cell,
                        const ColourWeights& weights,
                        float scale) {
        const hn::FixedTag<float, 4> d4;
        float* HWY_RESTRICT sums = sums_[block].data();
        if (((used_ >> block) & 1U) == 0) {
            used_ |= std::uint64_t{1} << block;
            sums_[block].fill(0);
        }
        const std::array<float, 4> padded{weights[0], weights[1], weights[2], 0};
        const auto w = hn::Mul(hn::Set(d4, scale), hn::LoadU(d4, padded.data()));
        const std::size_t count = cell[0];
        const std::uint8_t* slots = cell + 1;
        const auto* values = reinterpret_cast<const std::int8_t*>(slots + count);
        for (std::size_t i = 0; i < count; ++i) {
            float* slot = sums + std::size_t{4} * slots[i];
            const auto value = hn::Set(d4, static_cast<float>(values[i]));
            hn::Store(hn::MulAdd(w, value, hn::Load(d4, slot)), d4, slot);
        }
    }

    void add_to(const SumTargets& targets) const {
        for (std::uint64_t left = used_; left != 0; left &= left - 1) {
            const auto block = static_cast<std::size_t>(std::countr_zero(left));
            add_block(sums_[block].data(), targets.sums + block * kSumsPerBlock);
            if (targets.total != nullptr) {
                add_block(sums_[block].data(), targets.total + block * kSumsPerBlock);
            }
        }
    }

  private:
    static void add_block(const float* HWY_RESTRICT sums, float* HWY_RESTRICT target) {
        const hn::FixedTag<float, 4> d4;
        for (std::size_t slot = 0; slot < kBlockSize; slot += 4) {
            hn::Vec<decltype(d4)> red, green, blue, unused;
            hn::LoadInterleaved4(d4, sums + 4 * slot, red, green, blue, unused);
            add_one(d4, red, target + slot);
            add_one(d4, green, target + kBlockSize + slot);
            add_one(d4, blue, target + 2 * kBlockSize + slot);
        }
    }

    alignas(
        64) std::array<std::array<float, 4 * kBlockSize>, transport::kMaxBlocksPerShard> sums_;
    std::uint64_t used_ = 0;
};
static_assert(transport::kMaxBlocksPerShard <= 64);

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
