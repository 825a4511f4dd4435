// What dense cells add up to. Compiled once per instruction set, as Highway's own "-inl"
// headers are.
#if defined(RELUME_DENSE_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_DENSE_SUMS_INL_H
#undef RELUME_DENSE_SUMS_INL_H
#else
#define RELUME_DENSE_SUMS_INL_H
#endif

#include "server/engine/kernels/accumulate.h"

#include <hwy/highway.h>

#include <array>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

// Cells that are summed together, each with its weights. Cells lie at any address.
struct DenseRuns {
    std::array<const std::uint8_t*, kMaxGroupSegments> cells;
    std::array<const float*, kMaxGroupSegments> weights;
    std::size_t count = 0;

    void add(const std::uint8_t* cell, const ColourWeights& cell_weights) {
        cells[count] = cell;
        weights[count++] = cell_weights.data();
    }
};

// A few vectors of slots in three colours, summed in registers: as many as there are registers
// for.
template <typename D>
struct Registers {
#if HWY_TARGET == HWY_AVX3
    static constexpr std::size_t kVectors = 4;
#else
    static constexpr std::size_t kVectors = 2;
#endif
    hwy::HWY_NAMESPACE::Vec<D> red[kVectors], green[kVectors], blue[kVectors];

    HWY_INLINE void clear(D df) {
        for (std::size_t v = 0; v < kVectors; ++v) {
            red[v] = green[v] = blue[v] = hwy::HWY_NAMESPACE::Zero(df);
        }
    }

    template <typename Value>
    HWY_INLINE void add(D df, const DenseRuns& runs, std::size_t slot) {
        namespace hn = hwy::HWY_NAMESPACE;
        for (std::size_t s = 0; s < runs.count; ++s) {
            const std::uint8_t* HWY_RESTRICT values = runs.cells[s] + slot * sizeof(Value);
            const float* HWY_RESTRICT weights = runs.weights[s];
            const auto r = hn::Set(df, weights[0]);
            const auto g = hn::Set(df, weights[1]);
            const auto b = hn::Set(df, weights[2]);
            for (std::size_t v = 0; v < kVectors;
                 ++v, values += hn::Lanes(df) * sizeof(Value)) {
                const auto value = load_values<Value>(df, values);
                red[v] = hn::MulAdd(r, value, red[v]);
                green[v] = hn::MulAdd(g, value, green[v]);
                blue[v] = hn::MulAdd(b, value, blue[v]);
            }
        }
    }

    HWY_INLINE void add_to(D df, float* HWY_RESTRICT sums) const {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hwy::HWY_NAMESPACE::Lanes(df)) {
            add_one(df, red[v], sums);
            add_one(df, green[v], sums + transport::kBlockSize);
            add_one(df, blue[v], sums + 2 * transport::kBlockSize);
        }
    }

  private:
    template <typename Value>
    static HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load_values(D df, const std::uint8_t* values) {
        namespace hn = hwy::HWY_NAMESPACE;
        const hn::Rebind<Value, D> dv;
        const hn::Repartition<std::uint8_t, decltype(dv)> bytes;
        const auto loaded = hn::BitCast(dv, hn::LoadU(bytes, values));
        if constexpr (sizeof(Value) == sizeof(float)) {
            return loaded;
        } else {
            const hn::Rebind<std::int32_t, D> d32;
            return hn::ConvertTo(df, hn::PromoteTo(d32, loaded));
        }
    }

    static HWY_INLINE void add_one(D df,
                                   hwy::HWY_NAMESPACE::Vec<D> sum,
                                   float* HWY_RESTRICT target) {
        namespace hn = hwy::HWY_NAMESPACE;
        hn::StoreU(hn::Add(hn::LoadU(df, target), sum), df, target);
    }
};

// The dense cells of one block in one group.
struct DenseSums {
    DenseRuns bits8, bits16, floats;

    void clear() { bits8.count = bits16.count = floats.count = 0; }

    // Sums pass through registers once for all cells. `total` may be null.
    void add_to(float* HWY_RESTRICT sums, float* HWY_RESTRICT total) const {
        if (bits8.count + bits16.count + floats.count == 0) {
            return;
        }
        const hwy::HWY_NAMESPACE::CappedTag<float, 16> df;
        Registers<decltype(df)> registers;
        const std::size_t slots =
            Registers<decltype(df)>::kVectors * hwy::HWY_NAMESPACE::Lanes(df);
        for (std::size_t slot = 0; slot < transport::kBlockSize; slot += slots) {
            registers.clear(df);
            registers.template add<std::int8_t>(df, bits8, slot);
            registers.template add<std::int16_t>(df, bits16, slot);
            registers.template add<float>(df, floats, slot);
            registers.add_to(df, sums + slot);
            if (total != nullptr) {
                registers.add_to(df, total + slot);
            }
        }
    }
};

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
