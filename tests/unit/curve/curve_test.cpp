#include "protocol/curve/curve.h"

#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace relume::curve {
namespace {

TEST(Curve, HatsAreASharedOne) {
    for (int i = -10; i <= 10010; ++i) {
        const float u = static_cast<float>(i) / 10000;
        const CurvePlace place = curve_place(u);
        ASSERT_LE(place.sample, 254U);
        ASSERT_GE(place.fraction, 0);
        ASSERT_LE(place.fraction, 1);
        // The place is that of u.
        const double expected = std::min(std::max(static_cast<double>(u), 0.0), 1.0) * 255;
        ASSERT_NEAR(static_cast<double>(place.sample) + static_cast<double>(place.fraction),
                    expected, 1e-4);
        // And a constant stays one: the two weights sum to one.
        ASSERT_NEAR(constant_curve({1, 2, 3}).at(u).z, 3, 1e-6F);
    }
    EXPECT_EQ(curve_place(std::numeric_limits<float>::quiet_NaN()).sample, 0U);
    EXPECT_EQ(curve_place(std::numeric_limits<float>::infinity()).fraction, 1);
}

TEST(Curve, HasItsSamplesAndIsLinearBetween) {
    const Curve curve = curve_from_function(
        [](double u) { return Imath::V3d(2 * u, 1 - u, 1 + std::sin(7 * u)); });
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        const auto u = static_cast<float>(curve_u(k));
        EXPECT_NEAR((curve.at(u) - curve.sample(k)).length(), 0, 2e-6F);
    }
    for (float u = 0; u <= 1; u += 0.00137F) {
        const Imath::V3f value = curve.at(u);
        EXPECT_NEAR(value.x, 2 * u, 1e-6F);
        EXPECT_NEAR(value.y, 1 - u, 1e-6F);
        // h²/8·|f''| with h = 1/255.
        EXPECT_NEAR(value.z, 1 + std::sin(7 * u), 49.0 / 255 / 255 / 8 + 1e-6);
    }
    EXPECT_FALSE(curve.is_grey());
    EXPECT_TRUE(constant_curve(Imath::V3f(2)).is_grey());
    EXPECT_EQ(tinted(curve, {2, 0, 1}).sample(9), curve.sample(9) * Imath::V3f(2, 0, 1));
}

TEST(Curve, RefusesWhatIsNoReflectance) {
    const auto with = [](float value) {
        Curve curve = constant_curve(Imath::V3f(1));
        curve.rgb[1][37] = value;
        return curve;
    };
    EXPECT_NO_THROW(require_valid(with(0), "curve x"));
    EXPECT_NO_THROW(require_valid(with(kMostCurveValue), "curve x"));
    for (const float value :
         {-1e-9F, 1e30F, kMostCurveValue * 1.01F, std::numeric_limits<float>::quiet_NaN(),
          std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
        expect_curve_error([&] { require_valid(with(value), "curve x"); },
                           "in green of sample 37");
    }
}

}  // namespace
}  // namespace relume::curve
