// What the dense cells of a block add up to. Compiled once per instruction set,
// as Highway's own "-inl" headers are.
#if defined(RELUME_BLOCK_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_BLOCK_SUMS_INL_H
#undef RELUME_BLOCK_SUMS_INL_H
#else
#define RELUME_BLOCK_SUMS_INL_H
#endif

#include "server/engine/kernels/accumulate.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

namespace hn = hwy::HWY_NAMESPACE;
using transport::kBlockSize;
using transport::kColours;

inline constexpr std::size_t kSumsPerBlock = kColours * kBlockSize;

// Values that are summed together, each run with its weights.
template <typename Value>
struct CellValues {
    std::array<const Value*, kMaxGroupSegments> values;
    std::array<const float*, kMaxGroupSegments> weights;
    std::size_t count = 0;

    void add(const Value* run, const ColourWeights& run_weights) {
        values[count] = run;
        weights[count] = run_weights.data();
        ++count;
    }
};

template <typename D>
HWY_INLINE void add_one(D df, hn::Vec<D> sum, float* HWY_RESTRICT target) {
    hn::StoreU(hn::Add(hn::LoadU(df, target), sum), df, target);
}

template <typename D>
HWY_INLINE hn::Vec<D> load_values(D df, const std::int8_t* values) {
    const hn::Rebind<std::int32_t, D> d32;
    const hn::Rebind<std::int8_t, D> d8;
    return hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d8, values)));
}

template <typename D>
HWY_INLINE hn::Vec<D> load_values(D df, const std::int16_t* values) {
    const hn::Rebind<std::int32_t, D> d32;
    const hn::Rebind<std::int16_t, D> d16;
    return hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d16, values)));
}

template <typename D>
HWY_INLINE hn::Vec<D> load_values(D df, const float* values) {
    return hn::LoadU(df, values);
}

// Vectors of slots in three colours, summed in registers: with weights and a value as many as
// AVX2 has registers for.
template <typename D>
struct Registers {
    static constexpr std::size_t kVectors = 4;
    hn::Vec<D> red[kVectors], green[kVectors], blue[kVectors];

    // Written out, for what the compiler adds by itself has not the instructions of vectors.
    HWY_ATTR Registers() {}  // NOLINT(modernize-use-equals-default)

    HWY_INLINE void clear(D df) {
        for (std::size_t v = 0; v < kVectors; ++v) {
            red[v] = green[v] = blue[v] = hn::Zero(df);
        }
    }

    HWY_INLINE void load(D df, const float* HWY_RESTRICT sums) {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            red[v] = hn::LoadU(df, sums);
            green[v] = hn::LoadU(df, sums + kBlockSize);
            blue[v] = hn::LoadU(df, sums + 2 * kBlockSize);
        }
    }

    HWY_INLINE void store(D df, float* HWY_RESTRICT sums) const {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            hn::StoreU(red[v], df, sums);
            hn::StoreU(green[v], df, sums + kBlockSize);
            hn::StoreU(blue[v], df, sums + 2 * kBlockSize);
        }
    }

    template <typename Value>
    HWY_INLINE void add(D df, const CellValues<Value>& cells, std::size_t slot) {
        for (std::size_t s = 0; s < cells.count; ++s) {
            const Value* HWY_RESTRICT values = cells.values[s] + slot;
            const float* HWY_RESTRICT weights = cells.weights[s];
            const auto r = hn::Set(df, weights[0]);
            const auto g = hn::Set(df, weights[1]);
            const auto b = hn::Set(df, weights[2]);
            for (std::size_t v = 0; v < kVectors; ++v) {
                const auto value = load_values(df, values + v * hn::Lanes(df));
                red[v] = hn::MulAdd(r, value, red[v]);
                green[v] = hn::MulAdd(g, value, green[v]);
                blue[v] = hn::MulAdd(b, value, blue[v]);
            }
        }
    }

    HWY_INLINE void add(D df, const float* HWY_RESTRICT sums) {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            red[v] = hn::Add(red[v], hn::LoadU(df, sums));
            green[v] = hn::Add(green[v], hn::LoadU(df, sums + kBlockSize));
            blue[v] = hn::Add(blue[v], hn::LoadU(df, sums + 2 * kBlockSize));
        }
    }

    HWY_INLINE void add_to(D df, float* HWY_RESTRICT sums) const {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            add_one(df, red[v], sums);
            add_one(df, green[v], sums + kBlockSize);
            add_one(df, blue[v], sums + 2 * kBlockSize);
        }
    }
};

// The cells of one block that are summed together.
class BlockValues {
  public:
    CellValues<std::int8_t> bits8;
    CellValues<std::int16_t> bits16;
    CellValues<float> floats;

    void clear() { bits8.count = bits16.count = floats.count = 0; }

    // Sums pass through registers once for all cells and what the block's strips add up to,
    // null if there are none.
    void add_to(const float* HWY_RESTRICT strips,
                float* HWY_RESTRICT sums,
                float* HWY_RESTRICT total) const {
        const hn::CappedTag<float, 16> df;
        for_each_part([&](auto& registers, std::size_t slot) HWY_ATTR {
            registers.clear(df);
            add_part(registers, slot);
            if (strips != nullptr) {
                registers.add(df, strips + slot);
            }
            registers.add_to(df, sums + slot);
            if (total != nullptr) {
                registers.add_to(df, total + slot);
            }
        });
    }

    // The sums so far, [3][256], go on.
    void go_on(float* HWY_RESTRICT sums) const {
        const hn::CappedTag<float, 16> df;
        for_each_part([&](auto& registers, std::size_t slot) HWY_ATTR {
            registers.load(df, sums + slot);
            add_part(registers, slot);
            registers.store(df, sums + slot);
        });
    }

  private:
    using BlockRegisters = Registers<hn::CappedTag<float, 16>>;

    template <typename Part>
    HWY_INLINE void for_each_part(const Part& part) const {
        const hn::CappedTag<float, 16> df;
        BlockRegisters registers;
        const std::size_t slots = BlockRegisters::kVectors * hn::Lanes(df);
        for (std::size_t slot = 0; slot < kBlockSize; slot += slots) {
            part(registers, slot);
        }
    }

    HWY_INLINE void add_part(BlockRegisters& registers, std::size_t slot) const {
        const hn::CappedTag<float, 16> df;
        registers.add(df, bits8, slot);
        registers.add(df, bits16, slot);
        registers.add(df, floats, slot);
    }
};

// What a block's cells add up to group after group, [3][256], until there are no more.
class GroupSums {
  public:
    void clear() { used_ = 0; }

    void add(std::uint32_t block, const BlockValues& values) {
        if (((used_ >> block) & 1U) == 0) {
            used_ |= std::uint64_t{1} << block;
            sums_[block].fill(0);
        }
        values.go_on(sums_[block].data());
    }

    // With what their strips add up to, strips_of(block), null if there are none.
    template <typename StripsOf>
    void add_to(const SumTargets& targets, const StripsOf& strips_of) {
        const hn::CappedTag<float, 16> df;
        for (std::uint64_t left = used_; left != 0; left &= left - 1) {
            const auto block = static_cast<std::uint32_t>(std::countr_zero(left));
            const float* strips = strips_of(block);
            for (std::size_t i = 0; i < kSumsPerBlock; i += hn::Lanes(df)) {
                auto sum = hn::LoadU(df, &sums_[block][i]);
                if (strips != nullptr) {
                    sum = hn::Add(sum, hn::LoadU(df, strips + i));
                }
                add_one(df, sum, targets.sums + block * kSumsPerBlock + i);
                if (targets.total != nullptr) {
                    add_one(df, sum, targets.total + block * kSumsPerBlock + i);
                }
            }
        }
    }
    // Bit b: block b has sums.
    [[nodiscard]] std::uint64_t used() const { return used_; }

  private:
    alignas(
        64) std::array<std::array<float, kSumsPerBlock>, transport::kMaxBlocksPerShard> sums_;
    std::uint64_t used_ = 0;
};

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
