// A curve: one factor of a BRDF, a function of one angle, as 256 samples of red, green and blue
// [BenArtzi06]. Sample k stands at u = k/255, u being the angle as curve_angle.h maps it to
// [0, 1]. Between samples a curve is linear, so that what a surface reflects is exactly linear
// in the samples: a pair of directions whose angle is u gives its share to two of them.
//
// Pure functions of values; thread-safe.
#pragma once

#include "protocol/curve/error.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace relume::curve {

inline constexpr std::size_t kCurveSamples = 256;
// No sample is larger. The highest peak that a shape has (curve_shape.h) is a third of it.
inline constexpr float kMostCurveValue = 1e6F;

// Sample `sample` has the weight 1 − fraction, sample + 1 the weight fraction.
struct CurvePlace {
    std::uint32_t sample = 0;  // 0 … 254
    float fraction = 0;        // 0 … 1
};

// u below 0 counts as 0, also what is no number; u above 1 counts as 1.
[[nodiscard]] inline CurvePlace curve_place(float u) {
    constexpr auto kLast = static_cast<float>(kCurveSamples - 1);
    const float at = (u > 0 ? (u < 1 ? u : 1.0F) : 0.0F) * kLast;
    const auto sample = static_cast<std::uint32_t>(at < kLast - 1 ? at : kLast - 1);
    return {sample, at - static_cast<float>(sample)};
}

// u of a sample.
[[nodiscard]] inline double curve_u(std::size_t sample) {
    return static_cast<double>(sample) / static_cast<double>(kCurveSamples - 1);
}

struct Curve {
    std::array<std::array<float, kCurveSamples>, 3> rgb{};

    [[nodiscard]] Imath::V3f at(const CurvePlace& place) const {
        const auto value = [&](const std::array<float, kCurveSamples>& channel) {
            return (1 - place.fraction) * channel[place.sample] +
                   place.fraction * channel[place.sample + 1];
        };
        return {value(rgb[0]), value(rgb[1]), value(rgb[2])};
    }
    [[nodiscard]] Imath::V3f at(float u) const { return at(curve_place(u)); }

    [[nodiscard]] Imath::V3f sample(std::size_t k) const {
        return {rgb[0][k], rgb[1][k], rgb[2][k]};
    }
    void set_sample(std::size_t k, const Imath::V3f& value) {
        rgb[0][k] = value.x;
        rgb[1][k] = value.y;
        rgb[2][k] = value.z;
    }
    // Red, green and blue are the same.
    [[nodiscard]] bool is_grey() const { return rgb[0] == rgb[1] && rgb[1] == rgb[2]; }

    friend bool operator==(const Curve&, const Curve&) = default;
};

[[nodiscard]] Curve constant_curve(const Imath::V3f& value);
// value(u) at every sample's u, in double; not checked.
[[nodiscard]] Curve curve_from_function(const std::function<Imath::V3d(double u)>& value);
// The same curve with every sample multiplied.
[[nodiscard]] Curve tinted(const Curve& curve, const Imath::V3f& tint);

// Throws CurveError, which begins with `what`, unless every sample is finite and in [0,
// kMostCurveValue].
void require_valid(const Curve& curve, std::string_view what);

}  // namespace relume::curve
