#include "protocol/curve/curve_preset.h"

#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::curve {
namespace {

TEST(CurvePreset, WeightsAddToOne) {
    for (const CurvePreset& preset : curve_presets()) {
        double sum = 0;
        for (const PresetPart& part : preset.parts) {
            sum += part.weight;
        }
        EXPECT_NEAR(sum, 1, 1e-12) << preset.name;
        EXPECT_NO_THROW(require_valid(preset.curve(), preset.name));
    }
}

// What metals look like, straight on: the order of their colours, and how much they reflect.
TEST(CurvePreset, MetalsHaveTheirColours) {
    const auto straight_on = [](const char* name) {
        return preset_from_name(name).curve().sample(0);
    };
    const Imath::V3f gold = straight_on("gold");
    EXPECT_GT(gold.x, 0.9F);
    EXPECT_GT(gold.x, gold.y + 0.1F);
    EXPECT_GT(gold.y, gold.z + 0.3F);
    const Imath::V3f copper = straight_on("copper");
    EXPECT_GT(copper.x, 0.85F);
    EXPECT_GT(copper.x, copper.y + 0.2F);
    EXPECT_GT(copper.y, copper.z);
    for (const char* name : {"silver", "aluminium"}) {
        const Imath::V3f white = straight_on(name);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(white[c], 0.88F) << name;
            EXPECT_NEAR(white[c], white.y, 0.05F) << name;
        }
    }
    // All of them reflect all at grazing angles.
    EXPECT_NEAR((preset_from_name("gold").curve().sample(255) - Imath::V3f(1)).length(), 0,
                1e-6F);
}

TEST(CurvePreset, APearlIsSharpAndHazy) {
    const Curve pearl = preset_from_name("pearl").curve();
    const Imath::V3d haze_values[]{Imath::V3d(0.35)};
    const Curve haze = curve_from_shape(CurveShape::beckmann, CurveAngle::half, haze_values);
    const auto at = [](const Curve& curve, double degrees) {
        return curve.at(static_cast<float>(u_from_degrees(CurveAngle::half, degrees))).x;
    };
    EXPECT_GT(at(pearl, 0), 20 * at(haze, 0));
    EXPECT_NEAR(at(pearl, 25) / (0.65F * at(haze, 25)), 1, 0.05F);
}

TEST(CurvePreset, UnknownNamesAreRefusedWithNearOnes) {
    expect_curve_error([] { static_cast<void>(preset_from_name("sliver")); },
                       "did you mean silver");
    expect_curve_error([] { static_cast<void>(preset_from_name("unobtainium")); },
                       "found unobtainium");
}

}  // namespace
}  // namespace relume::curve
