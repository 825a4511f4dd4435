#include "protocol/curve/stroke.h"

#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace relume::curve {
namespace {

using Imath::V3d;
using Imath::V3f;

Curve base_curve() {
    return curve_from_function([](double u) { return V3d(1 + u, 0.3, std::exp(-3 * u)); });
}

TEST(Stroke, TouchesOnlyItsSamples) {
    const Curve curve = base_curve();
    for (const double softness : {0.0, 0.05, 1.0}) {
        const Curve drawn =
            with_stroke(curve, {curve_u(40), curve_u(80), softness, {V3d(7), V3d(9)}});
        for (std::size_t k = 0; k < kCurveSamples; ++k) {
            if (k < 40 || k > 80) {
                ASSERT_EQ(drawn.sample(k), curve.sample(k)) << k;
            } else if (k > 40 && k < 80) {
                ASSERT_NE(drawn.sample(k), curve.sample(k)) << k;
            }
        }
    }
}

TEST(Stroke, HasItsValuesWhereItIsHard) {
    const Curve drawn =
        with_stroke(base_curve(), {curve_u(40), curve_u(80), 0, {V3d(2), V3d(4), V3d(0)}});
    EXPECT_NEAR(drawn.sample(40).x, 2, 1e-6F);
    EXPECT_NEAR(drawn.sample(50).y, 3, 1e-6F);
    EXPECT_NEAR(drawn.sample(60).z, 4, 1e-6F);
    EXPECT_NEAR(drawn.sample(75).x, 1, 1e-6F);
    EXPECT_NEAR(drawn.sample(80).x, 0, 1e-6F);
}

TEST(Stroke, SoftEndsLeadFromWhatWasThere) {
    const Curve curve = base_curve();
    const Curve drawn = with_stroke(curve, {curve_u(40), curve_u(80), curve_u(10), {V3d(5)}});
    EXPECT_EQ(drawn.sample(40), curve.sample(40));
    EXPECT_EQ(drawn.sample(80), curve.sample(80));
    EXPECT_NEAR((drawn.sample(45) - (curve.sample(45) + V3f(5)) / 2).length(), 0, 1e-5F);
    // A quarter of the way: x²(3 − 2x) at 0.2.
    const float weight = 0.2F * 0.2F * (3 - 0.4F);
    EXPECT_NEAR(drawn.sample(78).x, curve.sample(78).x * (1 - weight) + 5 * weight, 1e-5F);
    for (std::size_t k = 50; k <= 70; ++k) {
        EXPECT_NEAR(drawn.sample(k).x, 5, 1e-5F);
    }
}

TEST(Stroke, OverTheWholeCurveOrOneSampleOrNone) {
    EXPECT_EQ(with_stroke(base_curve(), {0, 1, 0, {V3d(2)}}), constant_curve(V3f(2)));
    const Curve curve = base_curve();
    Curve one = curve;
    one.set_sample(255, V3f(2));
    EXPECT_EQ(with_stroke(curve, {1, 1, 0, {V3d(2), V3d(3)}}), one);
    EXPECT_EQ(with_stroke(curve, {0.5001, 0.5002, 0, {V3d(2)}}), curve);
}

TEST(Stroke, RefusesWhatIsNone) {
    const auto draw = [](Stroke stroke) {
        return [stroke] { static_cast<void>(with_stroke(base_curve(), stroke)); };
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<V3d> values{V3d(1)};
    expect_curve_error(draw({0.5, 0.4, 0, values}), "u from 0.5 to 0.4");
    expect_curve_error(draw({-0.1, 0.4, 0, values}), "u from -0.1");
    expect_curve_error(draw({0, nan, 0, values}), "to nan");
    expect_curve_error(draw({0, 1, 2, values}), "softness 2");
    expect_curve_error(draw({0, 1, nan, values}), "softness nan");
    expect_curve_error(draw({0, 1, 0, {}}), "found 0 values");
    expect_curve_error(draw({0, 1, 0, std::vector<V3d>(257, V3d(1))}), "found 257 values");
    expect_curve_error(draw({0, 1, 0, {V3d(1), V3d(1e30)}}), "1e+30 in value 1");
    expect_curve_error(draw({0, 1, 0, {V3d(-1)}}), "found -1");
}

}  // namespace
}  // namespace relume::curve
