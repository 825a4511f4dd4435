#include "protocol/light/low_pass.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "protocol/light/low_pass_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relume::light::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void add_window(const LowPassWindow& window, const Imath::V3f& centre, float sum[4]) {
    const hn::CappedTag<float, 8> d;  // windows are about ten texels wide
    const auto one = hn::Set(d, 1.0F);
    const auto zero = hn::Zero(d);
    const auto scale = hn::Set(d, window.inverse_radius_sq);
    const auto cx = hn::Set(d, centre.x);
    const auto cy = hn::Set(d, centre.y);
    const auto cz = hn::Set(d, centre.z);
    auto red = zero;
    auto green = zero;
    auto blue = zero;
    auto solid_angle = zero;
    const std::size_t count = window.end_column - window.first_column;
    for (std::uint32_t row = window.first_row; row < window.end_row; ++row) {
        const std::size_t begin = row * window.row_stride + window.first_column;
        for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
            const auto plane = [&](std::size_t p) {
                return hn::LoadU(d, window.planes[p] + begin + i);
            };
            const auto dx = hn::Sub(plane(0), cx);
            const auto dy = hn::Sub(plane(1), cy);
            const auto dz = hn::Sub(plane(2), cz);
            const auto distance_sq = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
            const auto t = hn::Max(zero, hn::NegMulAdd(distance_sq, scale, one));
            const auto weight =
                hn::IfThenElseZero(hn::FirstN(d, count - i), hn::Mul(t, hn::Mul(t, t)));
            red = hn::MulAdd(weight, plane(3), red);
            green = hn::MulAdd(weight, plane(4), green);
            blue = hn::MulAdd(weight, plane(5), blue);
            solid_angle = hn::MulAdd(weight, plane(6), solid_angle);
        }
    }
    sum[0] += hn::GetLane(hn::SumOfLanes(d, red));
    sum[1] += hn::GetLane(hn::SumOfLanes(d, green));
    sum[2] += hn::GetLane(hn::SumOfLanes(d, blue));
    sum[3] += hn::GetLane(hn::SumOfLanes(d, solid_angle));
}

}  // namespace relume::light::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::light {

HWY_EXPORT(add_window);

void add_window(const LowPassWindow& window, const Imath::V3f& centre, float sum[4]) {
    HWY_DYNAMIC_DISPATCH(add_window)(window, centre, sum);
}

}  // namespace relume::light
#endif  // HWY_ONCE
