// The kernel of whole products for every instruction set Highway knows, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/strip_product.cpp"
#include "server/engine/kernels/strip_product.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

void multiply_bytes(const StripRun<std::int8_t>& run, std::span<const StripTarget> targets) {
    multiply_strips_scalar(run, targets);
}
void multiply_floats(const StripRun<float>& run, std::span<const StripTarget> targets) {
    multiply_float_strips_scalar(run, targets);
}

#else

namespace {

namespace hn = hwy::HWY_NAMESPACE;
using transport::kBlockSize;
using transport::kColours;
using transport::kStripSlots;

using Floats = hn::CappedTag<float, kStripSlots>;
using Vector = hn::Vec<Floats>;

HWY_INLINE Vector load_values(const std::int8_t* values) {
    const hn::Rebind<std::int32_t, Floats> d32;
    const hn::Rebind<std::int8_t, Floats> d8;
    return hn::ConvertTo(Floats(), hn::PromoteTo(d32, hn::LoadU(d8, values)));
}

HWY_INLINE Vector load_values(const float* values) {
    return hn::LoadU(Floats(), values);
}

// What strips at one place add up to, of some targets: one vector of slots, three colours.
template <std::size_t kTargets>
struct Sums {
    Vector colours[kTargets][kColours];

    // Written out, for what the compiler adds by itself has not the instructions of vectors.
    HWY_ATTR Sums() {
        for (auto& of_target : colours) {
            for (auto& sum : of_target) {
                sum = hn::Zero(Floats());
            }
        }
    }

    HWY_INLINE void add(Vector values, std::size_t column, const StripTarget* targets) {
        for (std::size_t t = 0; t < kTargets; ++t) {
            const float* weights = targets[t].weights + kWeightsPerColumn * column;
            for (std::size_t c = 0; c < kColours; ++c) {
                colours[t][c] =
                    hn::MulAdd(values, hn::Set(Floats(), weights[c]), colours[t][c]);
            }
        }
    }
};

// One vector of the slots at one place. Where registers suffice for both, even and odd strips
// are taken at once, for an addition must wait for the one before.
template <std::size_t kTargets, typename Value>
HWY_INLINE void multiply_place(const std::uint16_t* columns,
                               const Value* values,
                               std::size_t count,
                               float scale,
                               const StripTarget* targets,
                               std::size_t slot) {
    constexpr bool kBothFit = kTargets <= 2;
    Sums<kTargets> even;
    Sums<kTargets> odd;
    if constexpr (kBothFit) {
        std::size_t i = 0;
        for (; i + 1 < count; i += 2) {
            even.add(load_values(values + kStripSlots * i), columns[i], targets);
            odd.add(load_values(values + kStripSlots * (i + 1)), columns[i + 1], targets);
        }
        if (i < count) {
            even.add(load_values(values + kStripSlots * i), columns[i], targets);
        }
    } else {
        for (std::size_t i = 0; i < count; i += 2) {
            even.add(load_values(values + kStripSlots * i), columns[i], targets);
        }
        for (std::size_t i = 1; i < count; i += 2) {
            odd.add(load_values(values + kStripSlots * i), columns[i], targets);
        }
    }
    const Floats df;
    for (std::size_t t = 0; t < kTargets; ++t) {
        for (std::size_t c = 0; c < kColours; ++c) {
            float* sums = targets[t].sums + c * kBlockSize + slot;
            const auto both = hn::Add(even.colours[t][c], odd.colours[t][c]);
            hn::StoreU(hn::MulAdd(hn::Set(df, scale), both, hn::LoadU(df, sums)), df, sums);
        }
    }
}

template <std::size_t kTargets, typename Value>
void multiply_for(const StripRun<Value>& run, const StripTarget* targets) {
    for (std::size_t place = 0; place < transport::kStripsPerBlock; ++place) {
        const std::size_t begin = run.begins[place];
        const std::size_t count = run.begins[place + 1] - begin;
        if (count == 0) {
            continue;
        }
        for (std::size_t first = 0; first < kStripSlots; first += hn::Lanes(Floats())) {
            multiply_place<kTargets>(run.columns + begin,
                                     run.values + kStripSlots * begin + first, count, run.scale,
                                     targets, kStripSlots * place + first);
        }
    }
}

// As many targets at a time as AVX2 has registers for.
template <typename Value>
void multiply(const StripRun<Value>& run, std::span<const StripTarget> targets) {
    constexpr std::size_t kMostAtOnce = 4;
    while (!targets.empty()) {
        switch (targets.size()) {
            case 1:
                multiply_for<1>(run, targets.data());
                break;
            case 2:
                multiply_for<2>(run, targets.data());
                break;
            case 3:
                multiply_for<3>(run, targets.data());
                break;
            default:
                multiply_for<kMostAtOnce>(run, targets.data());
                break;
        }
        targets = targets.subspan(std::min(kMostAtOnce, targets.size()));
    }
}

}  // namespace

void multiply_bytes(const StripRun<std::int8_t>& run, std::span<const StripTarget> targets) {
    multiply(run, targets);
}
void multiply_floats(const StripRun<float>& run, std::span<const StripTarget> targets) {
    multiply(run, targets);
}

#endif  // HWY_SCALAR

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;
using transport::kStripSlots;

template <typename Value>
void multiply_as_specified(const StripRun<Value>& run, std::span<const StripTarget> targets) {
    for (const StripTarget& target : targets) {
        for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
            const std::size_t place = slot / kStripSlots;
            const std::size_t begin = run.begins[place];
            for (std::size_t c = 0; c < kColours; ++c) {
                std::array<float, 2> sums{};
                for (std::size_t i = begin; i < run.begins[place + 1]; ++i) {
                    float& sum = sums[(i - begin) % 2];
                    sum = std::fma(
                        target.weights[kWeightsPerColumn * run.columns[i] + c],
                        static_cast<float>(run.values[kStripSlots * i + slot % kStripSlots]),
                        sum);
                }
                float& total = target.sums[c * kBlockSize + slot];
                total = std::fma(run.scale, sums[0] + sums[1], total);
            }
        }
    }
}

bool runs_specification() {
    static const bool scalar = scalar_is_forced();
    if (!scalar) {
        apply_forced_target();
    }
    return scalar;
}

}  // namespace

HWY_EXPORT(multiply_bytes);
HWY_EXPORT(multiply_floats);

void multiply_strips_scalar(const StripRun<std::int8_t>& run,
                            std::span<const StripTarget> targets) {
    multiply_as_specified(run, targets);
}

void multiply_float_strips_scalar(const StripRun<float>& run,
                                  std::span<const StripTarget> targets) {
    multiply_as_specified(run, targets);
}

void multiply_strips(const StripRun<std::int8_t>& run, std::span<const StripTarget> targets) {
    if (runs_specification()) {
        multiply_strips_scalar(run, targets);
        return;
    }
    HWY_DYNAMIC_DISPATCH(multiply_bytes)(run, targets);
}

void multiply_float_strips(const StripRun<float>& run, std::span<const StripTarget> targets) {
    if (runs_specification()) {
        multiply_float_strips_scalar(run, targets);
        return;
    }
    HWY_DYNAMIC_DISPATCH(multiply_floats)(run, targets);
}

}  // namespace relume::engine
#endif
