// Numbers that change from image to image.
#include "tests/lab/sequences/curve.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>
#include <stdexcept>

namespace relume::lab {
namespace {

constexpr std::uint64_t kSeed = 5;

Curve curve_of(const char* json) {
    return curve_from_json(nlohmann::json::parse(json), "/curve", 0);
}

TEST(Curve, MeetsItsKeysAndStaysBeforeAndAfter) {
    for (const char* way : {"linear", "slow-fast-slow", "geometric", "hold"}) {
        const Curve curve = curve_from_json(
            {{"keys", {{3, 1.0}, {10, 8.0}, {20, 2.0}}}, {"way", way}}, "/curve", 0);
        EXPECT_DOUBLE_EQ(curve.at(0, kSeed), 1) << way;
        EXPECT_DOUBLE_EQ(curve.at(3, kSeed), 1) << way;
        EXPECT_DOUBLE_EQ(curve.at(10, kSeed), 8) << way;
        EXPECT_DOUBLE_EQ(curve.at(20, kSeed), 2) << way;
        EXPECT_DOUBLE_EQ(curve.at(1000, kSeed), 2) << way;
        EXPECT_EQ(curve.rests_from(), 20U) << way;
    }
}

TEST(Curve, WaysBetweenKeys) {
    const auto middle = [](const char* way) {
        return curve_from_json({{"keys", {{0, 1.0}, {10, 4.0}}}, {"way", way}}, "/curve", 0)
            .at(5, kSeed);
    };
    EXPECT_DOUBLE_EQ(middle("linear"), 2.5);
    EXPECT_DOUBLE_EQ(middle("slow-fast-slow"), 2.5);
    EXPECT_DOUBLE_EQ(middle("geometric"), 2);
    EXPECT_DOUBLE_EQ(middle("hold"), 1);
}

TEST(Curve, SlowFastSlowIsFastestInTheMiddle) {
    const Curve curve = curve_of(R"({"keys": [[0, 0], [100, 360]], "way": "slow-fast-slow"})");
    const auto speed = [&](std::uint32_t image) {
        return curve.at(image + 1, kSeed) - curve.at(image, kSeed);
    };
    for (std::uint32_t image = 0; image < 49; ++image) {
        EXPECT_LT(speed(image), speed(image + 1));
        EXPECT_NEAR(speed(image), speed(99 - image), 1e-9);
    }
}

TEST(Curve, SamplesRestWhereTheyLastChange) {
    const Curve curve = curve_of(R"({"samples": [1, 2, 3, 3, 3]})");
    EXPECT_EQ(curve.at(1, kSeed), 2);
    EXPECT_EQ(curve.at(100, kSeed), 3);
    EXPECT_EQ(curve.rests_from(), 2U);
    EXPECT_EQ(curve_of("7").rests_from(), 0U);
}

TEST(Curve, RandomValuesDependOnSeedStreamAndStepAlone) {
    const nlohmann::json json{{"random", {{"from", 2}, {"to", 9}, {"every", 4}}}};
    const Curve curve = curve_from_json(json, "/curve", 1);
    const Curve other = curve_from_json(json, "/curve", 2);
    std::set<double> values;
    for (std::uint32_t image = 0; image < 400; ++image) {
        const double value = curve.at(image, kSeed);
        values.insert(value);
        EXPECT_GE(value, 2);
        EXPECT_LE(value, 9);
        EXPECT_EQ(value, curve.at(image - image % 4, kSeed));
        EXPECT_EQ(value, curve_from_json(json, "/elsewhere", 1).at(image, kSeed));
        EXPECT_NE(value, curve.at(image, kSeed + 1));
        EXPECT_NE(value, other.at(image, kSeed));
    }
    EXPECT_EQ(values.size(), 100U);
    EXPECT_EQ(curve.rests_from(), Curve::kNever);
}

TEST(Curve, RefusesWhatIsNoCurve) {
    for (const char* json :
         {R"("fast")", R"({})", R"({"keys": []})", R"({"keys": [[0, 1], [0, 2]]})",
          R"({"keys": [[-1, 1]]})", R"({"keys": [[0, 1]], "way": "jump"})",
          R"({"keys": [[0, 0], [5, 1]], "way": "geometric"})", R"({"samples": []})",
          R"({"samples": [1, "two"]})", R"({"random": {"from": 0, "to": 1, "every": 0}})",
          R"({"random": {"from": 0, "to": 1, "every": 1, "way": "geometric"}})"}) {
        EXPECT_THROW((void)curve_of(json), std::invalid_argument) << json;
    }
}

}  // namespace
}  // namespace relume::lab
