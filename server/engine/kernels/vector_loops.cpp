// Plain loops over contiguous arrays for every instruction set Highway knows.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/vector_loops.cpp"
#include "server/engine/kernels/vector_loops.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void add_scaled_loop(const std::int16_t* HWY_RESTRICT values,
                     float weight,
                     std::size_t count,
                     float* HWY_RESTRICT sums) {
    const hn::ScalableTag<float> df;
    const hn::Rebind<std::int32_t, decltype(df)> d32;
    const hn::Rebind<std::int16_t, decltype(df)> d16;
    const auto w = hn::Set(df, weight);
    const std::size_t lanes = hn::Lanes(df);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto value = hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d16, values + i)));
        hn::StoreU(hn::Add(hn::LoadU(df, sums + i), hn::Mul(w, value)), df, sums + i);
    }
    for (; i < count; ++i) {
        sums[i] += weight * static_cast<float>(values[i]);
    }
}

double squared_norm_loop(const float* HWY_RESTRICT values, std::size_t count) {
    constexpr std::size_t kRun = 1024;
    const hn::CappedTag<float, 4> df;  // one order of additions on every target
    double sum = 0;
    for (std::size_t first = 0; first < count; first += kRun) {
        const std::size_t end = first + kRun < count ? first + kRun : count;
        auto run = hn::Zero(df);
        std::size_t i = first;
        for (; i + hn::Lanes(df) <= end; i += hn::Lanes(df)) {
            const auto v = hn::LoadU(df, values + i);
            run = hn::Add(run, hn::Mul(v, v));
        }
        sum += static_cast<double>(hn::GetLane(hn::SumOfLanes(df, run)));
        for (; i < end; ++i) {
            sum += static_cast<double>(values[i]) * static_cast<double>(values[i]);
        }
    }
    return sum;
}

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {

HWY_EXPORT(add_scaled_loop);
HWY_EXPORT(squared_norm_loop);

void add_scaled(std::span<const std::int16_t> values, float weight, std::span<float> sums) {
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(add_scaled_loop)(values.data(), weight, values.size(), sums.data());
}

double squared_norm(std::span<const float> values) {
    apply_forced_target();
    return HWY_DYNAMIC_DISPATCH(squared_norm_loop)(values.data(), values.size());
}

}  // namespace relume::engine
#endif
