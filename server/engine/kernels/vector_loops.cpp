// Plain loops over contiguous arrays for every instruction set Highway knows.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/vector_loops.cpp"
#include "server/engine/kernels/vector_loops.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Rows asked for before their turn; they lie apart by those of the other colours.
constexpr std::size_t kRowsAhead = 8;

// Four vectors of sums stay in registers while all rows go by.
template <typename Float>
HWY_INLINE void add_rows_of(const std::int8_t* HWY_RESTRICT table,
                            const WeightedRow* HWY_RESTRICT rows,
                            std::size_t row_count,
                            std::size_t count,
                            Float* HWY_RESTRICT sums) {
    std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR  // whose multiplication and addition are not fused
    const hn::ScalableTag<Float> df;
    const hn::Rebind<std::int32_t, decltype(df)> d32;
    const hn::Rebind<std::int8_t, decltype(df)> d8;
    const std::size_t lanes = hn::Lanes(df);
    const auto values = [&](std::size_t at) HWY_ATTR {
        const auto integers = hn::PromoteTo(d32, hn::LoadU(d8, table + at));
        if constexpr (sizeof(Float) == sizeof(double)) {
            return hn::PromoteTo(df, integers);
        } else {
            return hn::ConvertTo(df, integers);
        }
    };
    for (; i + 4 * lanes <= count; i += 4 * lanes) {
        auto sum0 = hn::LoadU(df, sums + i);
        auto sum1 = hn::LoadU(df, sums + i + lanes);
        auto sum2 = hn::LoadU(df, sums + i + 2 * lanes);
        auto sum3 = hn::LoadU(df, sums + i + 3 * lanes);
        for (std::size_t row = 0; row < row_count; ++row) {
            const auto weight = hn::Set(df, static_cast<Float>(rows[row].weight));
            const std::size_t first = rows[row].first + i;
            __builtin_prefetch(table + rows[std::min(row + kRowsAhead, row_count - 1)].first +
                               i);
            sum0 = hn::MulAdd(weight, values(first), sum0);
            sum1 = hn::MulAdd(weight, values(first + lanes), sum1);
            sum2 = hn::MulAdd(weight, values(first + 2 * lanes), sum2);
            sum3 = hn::MulAdd(weight, values(first + 3 * lanes), sum3);
        }
        hn::StoreU(sum0, df, sums + i);
        hn::StoreU(sum1, df, sums + i + lanes);
        hn::StoreU(sum2, df, sums + i + 2 * lanes);
        hn::StoreU(sum3, df, sums + i + 3 * lanes);
    }
    for (; i + lanes <= count; i += lanes) {
        auto sum = hn::LoadU(df, sums + i);
        for (std::size_t row = 0; row < row_count; ++row) {
            const auto weight = hn::Set(df, static_cast<Float>(rows[row].weight));
            sum = hn::MulAdd(weight, values(rows[row].first + i), sum);
        }
        hn::StoreU(sum, df, sums + i);
    }
#endif
    for (; i < count; ++i) {
        for (std::size_t row = 0; row < row_count; ++row) {
            sums[i] = std::fma(static_cast<Float>(rows[row].weight),
                               static_cast<Float>(table[rows[row].first + i]), sums[i]);
        }
    }
}

void add_rows_loop(const std::int8_t* HWY_RESTRICT table,
                   const WeightedRow* HWY_RESTRICT rows,
                   std::size_t row_count,
                   std::size_t count,
                   float* HWY_RESTRICT sums) {
    add_rows_of(table, rows, row_count, count, sums);
}

void add_rows_in_double_loop(const std::int8_t* HWY_RESTRICT table,
                             const WeightedRow* HWY_RESTRICT rows,
                             std::size_t row_count,
                             std::size_t count,
                             double* HWY_RESTRICT sums) {
    add_rows_of(table, rows, row_count, count, sums);
}

double squared_norm_loop(const float* HWY_RESTRICT values, std::size_t count) {
    constexpr std::size_t kRun = 1024;
    const hn::CappedTag<float, 4> df;  // one order of additions on every target
    double sum = 0;
    for (std::size_t first = 0; first < count; first += kRun) {
        const std::size_t end = first + kRun < count ? first + kRun : count;
        // Four sums side by side, for an addition waits for the one before it.
        auto run0 = hn::Zero(df), run1 = run0, run2 = run0, run3 = run0;
        const auto plus_square = [&](auto sum_so_far, std::size_t at) HWY_ATTR {
            const auto v = hn::LoadU(df, values + at);
            return hn::Add(sum_so_far, hn::Mul(v, v));
        };
        const std::size_t lanes = hn::Lanes(df);
        std::size_t i = first;
        for (; i + 4 * lanes <= end; i += 4 * lanes) {
            run0 = plus_square(run0, i);
            run1 = plus_square(run1, i + lanes);
            run2 = plus_square(run2, i + 2 * lanes);
            run3 = plus_square(run3, i + 3 * lanes);
        }
        const auto run = hn::Add(hn::Add(run0, run1), hn::Add(run2, run3));
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

HWY_EXPORT(add_rows_loop);
HWY_EXPORT(add_rows_in_double_loop);
HWY_EXPORT(squared_norm_loop);

void add_rows(std::span<const std::int8_t> table,
              std::span<const WeightedRow> rows,
              std::span<float> sums) {
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(add_rows_loop)
    (table.data(), rows.data(), rows.size(), sums.size(), sums.data());
}

void add_rows(std::span<const std::int8_t> table,
              std::span<const WeightedRow> rows,
              std::span<double> sums) {
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(add_rows_in_double_loop)
    (table.data(), rows.data(), rows.size(), sums.size(), sums.data());
}

double squared_norm(std::span<const float> values) {
    apply_forced_target();
    return HWY_DYNAMIC_DISPATCH(squared_norm_loop)(values.data(), values.size());
}

}  // namespace relume::engine
#endif
