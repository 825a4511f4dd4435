#include "protocol/light/look_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "protocol/light/look_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relume::light::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

bool find_taps_loop(const LookLevel& level,
                    const LookPoints& points,
                    std::size_t count,
                    LookTaps& taps) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto width = hn::Set(d, static_cast<float>(level.width));
    const auto height = hn::Set(d, static_cast<float>(level.height));
    const auto half = hn::Set(d, 0.5F);
    const auto one = hn::Set(d, 1.0F);
    const auto columns = hn::Set(di, static_cast<std::int32_t>(level.width));
    const auto rows = hn::Set(di, static_cast<std::int32_t>(level.height));
    const auto before = hn::Set(di, -1);
    bool all_are_inside = true;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto x = hn::Sub(hn::Mul(hn::Load(d, &points.places.x[i]), width), half);
        const auto y = hn::Sub(hn::Mul(hn::Load(d, &points.places.y[i]), height), half);
        const auto left = hn::Floor(x);
        const auto top = hn::Floor(y);
        const auto column = hn::ConvertTo(di, left);
        const auto row = hn::ConvertTo(di, top);
        const auto face =
            hn::BitCast(di, hn::Load(hn::RebindToUnsigned<decltype(di)>(), &points.faces[i]));
        // One texel more than is needed to the right, for the fourth number of a vector.
        const auto inside = hn::And(hn::And(hn::Gt(column, before), hn::Gt(row, before)),
                                    hn::And(hn::Lt(hn::Add(column, hn::Set(di, 2)), columns),
                                            hn::Lt(hn::Add(row, hn::Set(di, 1)), rows)));
        const auto narrow =
            hn::RebindMask(di, hn::Le(hn::Mul(hn::Load(d, &points.spans[i]), width), one));
        const auto texel = hn::Add(hn::Mul(hn::Add(hn::Mul(face, rows), row), columns), column);
        const auto offset = hn::Add(hn::ShiftLeft<1>(texel), texel);
        const auto usable = hn::And(inside, narrow);
        // Beyond the last point whatever there is may count: it is then looked at in vain.
        all_are_inside = all_are_inside && hn::AllTrue(di, usable);
        hn::Store(hn::IfThenElse(usable, offset, hn::Set(di, LookTaps::kNotInside)), di,
                  &taps.offsets[i]);
        hn::Store(hn::Sub(x, left), d, &taps.x_fractions[i]);
        hn::Store(hn::Sub(y, top), d, &taps.y_fractions[i]);
    }
    return all_are_inside;
}

// Points asked for before their turn: a turned row crosses the map at any slope, which no
// prefetcher of the processor follows.
constexpr std::size_t kLooksAhead = 8;

void add_taps_loop(const LookLevel& level,
                   const LookTaps& taps,
                   const LookNumbers& weights,
                   std::size_t count,
                   Imath::V3f* HWY_RESTRICT radiances) {
    const hn::CappedTag<float, 4> d;  // the colours, and a fourth number that is not used
    const auto one = hn::Set(d, 1.0F);
    const std::size_t below = std::size_t{3} * level.width;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t ahead = taps.offsets[std::min(i + kLooksAhead, count - 1)];
        if (ahead >= 0) {
            __builtin_prefetch(level.rgb + ahead);
            __builtin_prefetch(level.rgb + ahead + below);
        }
        if (taps.offsets[i] < 0 || weights[i] == 0) {
            continue;
        }
        const float* texel = level.rgb + taps.offsets[i];
        const auto x = hn::Set(d, taps.x_fractions[i]);
        const auto y = hn::Set(d, taps.y_fractions[i]);
        const auto rest_x = hn::Sub(one, x);
        const auto rest_y = hn::Sub(one, y);
        alignas(16) float mixed[4];
        for (std::size_t c = 0; c < 4; c += hn::Lanes(d)) {
            const auto along = [&](const float* row) HWY_ATTR {
                return hn::Add(hn::Mul(hn::LoadU(d, row + c), rest_x),
                               hn::Mul(hn::LoadU(d, row + c + 3), x));
            };
            const auto mean =
                hn::Add(hn::Mul(along(texel), rest_y), hn::Mul(along(texel + below), y));
            hn::Store(hn::Mul(mean, hn::Set(d, weights[i])), d, mixed + c);
        }
        radiances[i] += Imath::V3f(mixed[0], mixed[1], mixed[2]);
    }
}

}  // namespace relume::light::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::light {

HWY_EXPORT(find_taps_loop);
HWY_EXPORT(add_taps_loop);

bool find_taps(const LookLevel& level,
               const LookPoints& points,
               std::size_t count,
               LookTaps& taps) {
    return HWY_DYNAMIC_DISPATCH(find_taps_loop)(level, points, count, taps);
}

void add_taps(const LookLevel& level,
              const LookTaps& taps,
              const LookNumbers& weights,
              std::span<Imath::V3f> radiances) {
    HWY_DYNAMIC_DISPATCH(add_taps_loop)
    (level, taps, weights, radiances.size(), radiances.data());
}

}  // namespace relume::light
#endif  // HWY_ONCE
