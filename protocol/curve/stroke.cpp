#include "protocol/curve/stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relume::curve {
namespace {

void require_stroke(const Stroke& stroke) {
    if (!(stroke.from >= 0 && stroke.from <= stroke.to && stroke.to <= 1)) {
        throw CurveError(
            fmt::format("stroke: found u from {} to {}, expected 0 ≤ from ≤ to ≤ 1",
                        stroke.from, stroke.to));
    }
    if (!(stroke.softness >= 0 && stroke.softness <= 1)) {
        throw CurveError(
            fmt::format("stroke: found softness {}, expected 0 … 1", stroke.softness));
    }
    if (stroke.values.empty() || stroke.values.size() > Stroke::kMostValues) {
        throw CurveError(fmt::format("stroke: found {} values, expected 1 … {}",
                                     stroke.values.size(), Stroke::kMostValues));
    }
    for (std::size_t i = 0; i < stroke.values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double value = stroke.values[i][c];
            if (!(value >= 0 && value <= static_cast<double>(kMostCurveValue))) {
                throw CurveError(fmt::format("stroke: found {} in value {}, expected 0 … {}",
                                             value, i, kMostCurveValue));
            }
        }
    }
}

Imath::V3d value_at(const Stroke& stroke, double u) {
    const double length = stroke.to - stroke.from;
    const auto last = static_cast<double>(stroke.values.size() - 1);
    const double at = length > 0 ? std::clamp((u - stroke.from) / length, 0.0, 1.0) * last : 0;
    const auto before = static_cast<std::size_t>(at);
    const std::size_t after = std::min(before + 1, stroke.values.size() - 1);
    const double fraction = at - static_cast<double>(before);
    return stroke.values[before] * (1 - fraction) + stroke.values[after] * fraction;
}

double weight_at(const Stroke& stroke, double u) {
    if (stroke.softness == 0) {
        return 1;
    }
    const double x = std::min(1.0, std::min(u - stroke.from, stroke.to - u) / stroke.softness);
    return x * x * (3 - 2 * x);
}

}  // namespace

Curve with_stroke(const Curve& curve, const Stroke& stroke) {
    require_stroke(stroke);
    Curve result = curve;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        const double u = curve_u(k);
        if (u < stroke.from || u > stroke.to) {
            continue;
        }
        const double weight = weight_at(stroke, u);
        const Imath::V3d before(curve.sample(k));
        result.set_sample(k, Imath::V3f(before * (1 - weight) + value_at(stroke, u) * weight));
    }
    return result;
}

}  // namespace relume::curve
