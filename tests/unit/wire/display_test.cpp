#include "protocol/wire/display.h"

#include "protocol/wire/sections/display.h"
#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>

#include <limits>

namespace relume::wire {
namespace {

TEST(DisplayCurve, SharedCases) {
    for (const auto& c : vectors_from_file("display")) {
        const Display display{.exposure_stops = c.at("exposure_stops"),
                              .tone = *kToneNames.value(c.at("tone").get<std::string>())};
        EXPECT_EQ(code_from_linear(c.at("linear"), display), c.at("code")) << c;
    }
}

TEST(DisplayCurve, GrowsWithRadianceAndStaysInRange) {
    for (const Tone tone : {Tone::filmic, Tone::linear}) {
        for (const double stops : {-20.0, -1.0, 0.0, 20.0}) {
            const Display display{.exposure_stops = stops, .tone = tone};
            float previous = tone_mapped(0, display);
            EXPECT_EQ(previous, 0.0F);
            for (float linear = 1e-6F; linear < 1e9F; linear *= 1.3F) {
                const float shown = tone_mapped(linear, display);
                EXPECT_GE(shown, previous) << linear << " at " << stops << " stops";
                EXPECT_LE(shown, 1.0F);
                previous = shown;
            }
        }
    }
}

TEST(DisplayCurve, ShowsWhatIsNoNumberAsBlackAndInfinityAsWhite) {
    const Display display;
    EXPECT_EQ(code_from_linear(std::numeric_limits<float>::quiet_NaN(), display), 0);
    EXPECT_EQ(code_from_linear(-std::numeric_limits<float>::infinity(), display), 0);
    EXPECT_EQ(code_from_linear(std::numeric_limits<float>::infinity(), display), 255);
}

}  // namespace
}  // namespace relume::wire
