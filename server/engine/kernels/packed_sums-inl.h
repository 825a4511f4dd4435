// What packed cells (sparse, bitmap) add up to. Compiled once per instruction set, as Highway's
// own "-inl" headers are.
#if defined(RELUME_PACKED_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_PACKED_SUMS_INL_H
#undef RELUME_PACKED_SUMS_INL_H
#else
#define RELUME_PACKED_SUMS_INL_H
#endif

#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/set_bits.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

// Slots of the values of a bitmap cell.
class BitmapSlots {
  public:
    // Returns how many there are.
    HWY_INLINE std::size_t fill(const std::uint8_t* bitmap) {
        std::uint8_t* out = slots_.data();
        std::uint64_t first_slot = 0;
        for (std::size_t byte = 0; byte < transport::kBitmapBytes; ++byte) {
            std::uint64_t places = 0;
            std::memcpy(&places, kSetBits[bitmap[byte]].data(), sizeof(places));
            places += first_slot;
            std::memcpy(out, &places, sizeof(places));
            out += std::popcount(bitmap[byte]);
            first_slot += 0x0808'0808'0808'0808U;
        }
        return static_cast<std::size_t>(out - slots_.data());
    }
    [[nodiscard]] const std::uint8_t* data() const { return slots_.data(); }

  private:
    // Places are written, and slots read, eight at a time.
    std::array<std::uint8_t, transport::kBlockSize + 8> slots_;
};

// By block, colours side by side so that a value is one addition; zero until the block's first
// cell. May read 16 bytes beyond a cell: a shard's data has a tail (kShardTailBytes).
class PackedSums {
    using D4 = hwy::HWY_NAMESPACE::FixedTag<float, 4>;

  public:
    void clear() { used_ = 0; }

    // Adds a cell of this tag with `scale` times the weights.
    HWY_INLINE void add(std::uint32_t block,
                        transport::CellTag tag,
                        const std::uint8_t* cell,
                        const ColourWeights& weights,
                        float scale) {
        namespace hn = hwy::HWY_NAMESPACE;
        float* sums = sums_of(block);
        const std::array<float, 4> padded{weights[0], weights[1], weights[2], 0};
        const auto scaled = hn::Mul(hn::Set(D4(), scale), hn::LoadU(D4(), padded.data()));
        if (tag == transport::CellTag::sparse8) {
            const std::size_t count = cell[0];
            add_values<std::int8_t>(cell + 1, cell + 1 + count, count, scaled, sums);
            return;
        }
        const std::size_t count = bitmap_slots_.fill(cell);
        const std::uint8_t* values = cell + transport::kBitmapBytes;
        if (tag == transport::CellTag::bitmap8) {
            add_values<std::int8_t>(bitmap_slots_.data(), values, count, scaled, sums);
        } else {
            add_values<std::int16_t>(bitmap_slots_.data(), values, count, scaled, sums);
        }
    }

    void add_to(const SumTargets& targets) const {
        constexpr std::size_t kSumsPerBlock = transport::kColours * transport::kBlockSize;
        for (std::uint64_t left = used_; left != 0; left &= left - 1) {
            const auto block = static_cast<std::size_t>(std::countr_zero(left));
            add_block(sums_[block].data(), targets.sums + block * kSumsPerBlock);
            if (targets.total != nullptr) {
                add_block(sums_[block].data(), targets.total + block * kSumsPerBlock);
            }
        }
    }

  private:
    // Values are taken in runs. What fills the last one goes to slots that a block does not
    // have, each to its own: additions to one slot wait for each other.
    static constexpr std::size_t kRun =
        hwy::HWY_NAMESPACE::MaxLanes(hwy::HWY_NAMESPACE::CappedTag<float, 8>());
    static constexpr std::size_t kFloats = 4 * (transport::kBlockSize + kRun);
    // From place kRun − n on: 0 for the n values that a run has, those slots for the others.
    static constexpr std::array<std::int32_t, 2 * kRun> kUnfilled = [] {
        std::array<std::int32_t, 2 * kRun> slots{};
        for (std::size_t i = 0; i < kRun; ++i) {
            slots[kRun + i] = static_cast<std::int32_t>(transport::kBlockSize + i);
        }
        return slots;
    }();

    HWY_INLINE float* sums_of(std::uint32_t block) {
        if (((used_ >> block) & 1U) == 0) {
            used_ |= std::uint64_t{1} << block;
            sums_[block].fill(0);
        }
        return sums_[block].data();
    }

    template <typename Value>
    static HWY_INLINE void add_values(const std::uint8_t* HWY_RESTRICT slots,
                                      const std::uint8_t* HWY_RESTRICT values,
                                      std::size_t count,
                                      hwy::HWY_NAMESPACE::Vec<D4> weights,
                                      float* HWY_RESTRICT sums) {
        namespace hn = hwy::HWY_NAMESPACE;
        const hn::CappedTag<float, 8> df;
        const hn::Rebind<std::int32_t, decltype(df)> d32;
        const hn::Rebind<Value, decltype(df)> dv;
        const hn::Rebind<std::uint8_t, decltype(dv)> d8;
        const hn::Repartition<std::uint8_t, decltype(dv)> dv_bytes;
        alignas(32) std::array<float, kRun> run;
        alignas(32) std::array<std::int32_t, kRun> places;
        for (std::size_t first = 0; first < count; first += kRun) {
            const auto q = hn::BitCast(dv, hn::LoadU(dv_bytes, values + sizeof(Value) * first));
            hn::Store(hn::ConvertTo(df, hn::PromoteTo(d32, q)), df, run.data());
            const auto slot = hn::PromoteTo(d32, hn::LoadU(d8, slots + first));
            const auto unfilled =
                hn::LoadU(d32, &kUnfilled[kRun - std::min(kRun, count - first)]);
            hn::Store(hn::ShiftLeft<2>(hn::Max(slot, unfilled)), d32, places.data());
            for (std::size_t i = 0; i < kRun; ++i) {
                float* place = sums + places[i];
                hn::Store(hn::MulAdd(weights, hn::Set(D4(), run[i]), hn::Load(D4(), place)),
                          D4(), place);
            }
        }
    }

    static void add_block(const float* HWY_RESTRICT sums, float* HWY_RESTRICT target) {
        namespace hn = hwy::HWY_NAMESPACE;
        for (std::size_t slot = 0; slot < transport::kBlockSize; slot += 4) {
            hn::Vec<D4> red, green, blue, unused;
            hn::LoadInterleaved4(D4(), sums + 4 * slot, red, green, blue, unused);
            float* colours[] = {target + slot, target + transport::kBlockSize + slot,
                                target + 2 * transport::kBlockSize + slot};
            hn::StoreU(hn::Add(hn::LoadU(D4(), colours[0]), red), D4(), colours[0]);
            hn::StoreU(hn::Add(hn::LoadU(D4(), colours[1]), green), D4(), colours[1]);
            hn::StoreU(hn::Add(hn::LoadU(D4(), colours[2]), blue), D4(), colours[2]);
        }
    }

    alignas(64) std::array<std::array<float, kFloats>, transport::kMaxBlocksPerShard> sums_;
    BitmapSlots bitmap_slots_;
    std::uint64_t used_ = 0;
};
static_assert(transport::kMaxBlocksPerShard <= 64);

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
