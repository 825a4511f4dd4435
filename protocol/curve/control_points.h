// A curve through a few points: the cubic Hermite interpolant whose tangents are limited so
// that it rises and falls only where the points do [FritschCarlson80], each colour by itself.
// Between two points of one value it is that value; it passes every point, and has the first
// and the last point's value beyond them.
//
// On the logarithmic scale the logarithms of the values are interpolated. Pure; thread-safe.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/curve/curve.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::curve {

struct ControlPoint {
    double u = 0;
    Imath::V3d value{0, 0, 0};
};

enum class ValueScale : std::uint8_t { linear, logarithmic };

inline constexpr text::NameTable<ValueScale, 2> kValueScaleNames({{
    {ValueScale::linear, "linear"},
    {ValueScale::logarithmic, "logarithmic"},
}});

inline constexpr std::size_t kMostControlPoints = 32;
// Of values on the logarithmic scale.
inline constexpr double kLeastLogarithmicValue = 1e-6;

// Throws CurveError unless there are 1 … kMostControlPoints points with strictly rising u in
// [0, 1] and values in [0, kMostCurveValue], on the logarithmic scale from
// kLeastLogarithmicValue.
[[nodiscard]] Curve curve_from_points(std::span<const ControlPoint> points,
                                      ValueScale scale = ValueScale::linear);

}  // namespace relume::curve
