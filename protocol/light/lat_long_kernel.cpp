#include "protocol/light/lat_long_kernel.h"

#include <algorithm>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "protocol/light/lat_long_kernel.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relume::light::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The angle of the point (x, y), x ≥ 0 or not; 0 for (0, 0).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V angle(D d, V y, V x) {
    const auto zero = hn::Zero(d);
    const auto half_turn = hn::CopySign(hn::Set(d, std::numbers::pi_v<float>), y);
    const auto acute = hn::Atan(d, hn::Div(y, x));
    const auto turned = hn::IfThenElse(hn::Lt(x, zero), hn::Add(acute, half_turn), acute);
    return hn::IfThenZeroElse(hn::And(hn::Eq(x, zero), hn::Eq(y, zero)), turned);
}

void lat_long_points_loop(const LookDirections& directions,
                          std::size_t count,
                          LatLongPoints& points) {
    const hn::ScalableTag<float> d;
    const auto half = hn::Set(d, 0.5F);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto x = hn::Load(d, &directions.x[i]);
        const auto y = hn::Load(d, &directions.y[i]);
        const auto z = hn::Load(d, &directions.z[i]);
        const auto squared = hn::Add(hn::Mul(x, x), hn::Mul(z, z));
        const auto horizontal = hn::Sqrt(squared);
        const auto longitude = angle(d, x, hn::Neg(z));
        const auto latitude = angle(d, y, horizontal);
        const auto turns = hn::Set(d, std::numbers::inv_pi_v<float>);
        hn::Store(hn::Add(hn::Mul(longitude, hn::Mul(half, turns)), half), d, &points.x[i]);
        hn::Store(hn::Sub(half, hn::Mul(latitude, turns)), d, &points.y[i]);
        hn::Store(hn::Div(horizontal, hn::Sqrt(hn::Add(squared, hn::Mul(y, y)))), d,
                  &points.cos_latitude[i]);
    }
}

void footprint_spans_loop(const float* HWY_RESTRICT footprints_sr,
                          const float* HWY_RESTRICT cos_latitudes,
                          std::size_t count,
                          float* HWY_RESTRICT spans) {
    const hn::ScalableTag<float> d;
    const auto full_turn = hn::Set(d, 2 * std::numbers::pi_v<float>);
    const auto least = hn::Set(d, 1e-6F);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto around = hn::Max(hn::Mul(full_turn, hn::Load(d, cos_latitudes + i)), least);
        const auto side = hn::Sqrt(hn::Max(hn::Load(d, footprints_sr + i), hn::Zero(d)));
        hn::Store(hn::Min(hn::Set(d, 1.0F), hn::Div(side, around)), d, spans + i);
    }
}

void footprint_levels_loop(const float* HWY_RESTRICT footprints_sr,
                           float side_radians,
                           std::size_t count,
                           float* HWY_RESTRICT levels) {
    const hn::ScalableTag<float> d;
    const auto one_over_side = hn::Set(d, 1 / (side_radians * side_radians));
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto texels = hn::Mul(hn::Load(d, footprints_sr + i), one_over_side);
        hn::Store(hn::Mul(hn::Set(d, 0.5F), hn::Log2(d, texels)), d, levels + i);
    }
}

}  // namespace relume::light::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::light {

HWY_EXPORT(lat_long_points_loop);
HWY_EXPORT(footprint_levels_loop);
HWY_EXPORT(footprint_spans_loop);

void lat_long_points(const LookDirections& directions,
                     std::size_t count,
                     LatLongPoints& points) {
    HWY_DYNAMIC_DISPATCH(lat_long_points_loop)(directions, count, points);
}

void footprint_spans(std::span<const float> footprints_sr,
                     const LookNumbers& cos_latitudes,
                     LookNumbers& spans) {
    alignas(64) LookNumbers footprints{};
    std::copy(footprints_sr.begin(), footprints_sr.end(), footprints.begin());
    alignas(64) const LookNumbers cosines = cos_latitudes;
    alignas(64) LookNumbers all;
    HWY_DYNAMIC_DISPATCH(footprint_spans_loop)
    (footprints.data(), cosines.data(), footprints_sr.size(), all.data());
    spans = all;
}

void footprint_levels(std::span<const float> footprints_sr,
                      float side_radians,
                      LookNumbers& levels) {
    alignas(64) LookNumbers footprints{};
    std::copy(footprints_sr.begin(), footprints_sr.end(), footprints.begin());
    alignas(64) LookNumbers all;
    HWY_DYNAMIC_DISPATCH(footprint_levels_loop)
    (footprints.data(), side_radians, footprints_sr.size(), all.data());
    levels = all;
}

}  // namespace relume::light
#endif  // HWY_ONCE
