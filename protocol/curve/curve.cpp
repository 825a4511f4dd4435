#include "protocol/curve/curve.h"

#include <fmt/format.h>

namespace relume::curve {

Curve constant_curve(const Imath::V3f& value) {
    Curve curve;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        curve.set_sample(k, value);
    }
    return curve;
}

Curve curve_from_function(const std::function<Imath::V3d(double u)>& value) {
    Curve curve;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        curve.set_sample(k, Imath::V3f(value(curve_u(k))));
    }
    return curve;
}

Curve tinted(const Curve& curve, const Imath::V3f& tint) {
    Curve result = curve;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        result.set_sample(k, curve.sample(k) * tint);
    }
    return result;
}

void require_valid(const Curve& curve, std::string_view what) {
    constexpr std::array<std::string_view, 3> kChannels{"red", "green", "blue"};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        for (std::size_t k = 0; k < kCurveSamples; ++k) {
            const float value = curve.rgb[channel][k];
            if (!(value >= 0 && value <= kMostCurveValue)) {
                throw CurveError(fmt::format("{}: found {} in {} of sample {}, expected 0 … {}",
                                             what, value, kChannels[channel], k,
                                             kMostCurveValue));
            }
        }
    }
}

}  // namespace relume::curve
