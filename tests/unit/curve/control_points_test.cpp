#include "protocol/curve/control_points.h"

#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace relume::curve {
namespace {

using Imath::V3d;

// Points that stand at samples, with values of all sizes and some that repeat.
std::vector<ControlPoint> random_points(unsigned seed, double least) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-5, 5);
    std::vector<ControlPoint> points;
    for (std::size_t k = random() % 9; k < kCurveSamples && points.size() < 32;
         k += 1 + random() % 20) {
        V3d value(std::pow(10, exponent(random)), std::pow(10, exponent(random)), 1);
        if (!points.empty() && random() % 4 == 0) {
            value = points.back().value;
        }
        points.push_back({curve_u(k), V3d(least) + value});
    }
    return points;
}

TEST(ControlPoints, TheCurvePassesThemAndIsMonotoneBetween) {
    for (const ValueScale scale : {ValueScale::linear, ValueScale::logarithmic}) {
        for (unsigned seed = 0; seed < 200; ++seed) {
            const std::vector<ControlPoint> points = random_points(seed, 0);
            const Curve curve = curve_from_points(points, scale);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto k = static_cast<std::size_t>(std::lround(points[i].u * 255));
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(curve.sample(k)[c] / points[i].value[c], 1, 1e-5);
                }
                if (i + 1 == points.size()) {
                    continue;
                }
                const auto next = static_cast<std::size_t>(std::lround(points[i + 1].u * 255));
                for (int c = 0; c < 3; ++c) {
                    const double rise = points[i + 1].value[c] - points[i].value[c];
                    for (std::size_t s = k; s < next; ++s) {
                        const float step = curve.sample(s + 1)[c] - curve.sample(s)[c];
                        const float rounding = 4e-7F * curve.sample(s)[c];
                        ASSERT_TRUE(rise > 0   ? step >= -rounding
                                    : rise < 0 ? step <= rounding
                                               : std::fabs(step) <= rounding)
                            << seed << " " << s;
                    }
                }
            }
        }
    }
}

TEST(ControlPoints, BeyondTheEndsTheCurveIsFlat) {
    const std::vector<ControlPoint> points{{0.2, {1, 2, 3}}, {0.7, {5, 4, 9}}};
    const Curve curve = curve_from_points(points);
    EXPECT_EQ(curve.sample(0), Imath::V3f(1, 2, 3));
    EXPECT_EQ(curve.sample(51), Imath::V3f(1, 2, 3));
    EXPECT_EQ(curve.sample(179), Imath::V3f(5, 4, 9));
    EXPECT_EQ(curve.sample(255), Imath::V3f(5, 4, 9));
    const std::vector<ControlPoint> one{{0.5, {1, 0, 2}}};
    EXPECT_EQ(curve_from_points(one), constant_curve({1, 0, 2}));
}

TEST(ControlPoints, LinesStayLines) {
    std::vector<ControlPoint> points;
    for (const double u : {0.0, 0.1, 0.35, 1.0}) {
        points.push_back({u, {3 - 2 * u, u, std::exp(4 * u)}});
    }
    const Curve linear = curve_from_points(points);
    const Curve logarithmic = [&] {
        points[0].value.y = 1;  // no logarithm of 0
        return curve_from_points(points, ValueScale::logarithmic);
    }();
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        EXPECT_NEAR(linear.sample(k).x, 3 - 2 * curve_u(k), 1e-6);
        EXPECT_NEAR(linear.sample(k).y, curve_u(k), 1e-6);
        EXPECT_NEAR(logarithmic.sample(k).z / std::exp(4 * curve_u(k)), 1, 1e-6);
    }
}

TEST(ControlPoints, RefusesWhatMakesNoCurve) {
    const auto make = [](std::vector<ControlPoint> points, ValueScale scale) {
        return [points, scale] { static_cast<void>(curve_from_points(points, scale)); };
    };
    const auto linear = ValueScale::linear;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_curve_error(make({}, linear), "control points: found 0, expected 1 … 32");
    std::vector<ControlPoint> many;
    for (int i = 0; i < 33; ++i) {
        many.push_back({i / 33.0, V3d(1)});
    }
    expect_curve_error(make(many, linear), "found 33");
    expect_curve_error(make({{0.5, V3d(1)}, {0.5, V3d(2)}}, linear), "found u 0.5 after 0.5");
    expect_curve_error(make({{0.5, V3d(1)}, {0.4, V3d(2)}}, linear), "control point 1");
    expect_curve_error(make({{1.01, V3d(1)}}, linear), "found u 1.01");
    expect_curve_error(make({{nan, V3d(1)}}, linear), "found u nan");
    expect_curve_error(make({{0, {1, nan, 1}}}, linear), "found nan");
    expect_curve_error(make({{0, {1, 1, -1}}}, linear), "found -1");
    expect_curve_error(make({{0, V3d(1e30)}}, linear), "found 1e+30");
    expect_curve_error(make({{0, V3d(0)}}, ValueScale::logarithmic), "found 0, expected 1e-06");
}

}  // namespace
}  // namespace relume::curve
