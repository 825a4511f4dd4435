// Lighting sequences as files.
#include "tests/lab/sequences/lighting_sequence.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace relume::lab {
namespace {

bool same_rig(const light::LightRig& a, const light::LightRig& b) {
    bool same = a.rotation == b.rotation && a.environment_scale == b.environment_scale &&
                a.blend_amount == b.blend_amount && a.lights.size() == b.lights.size();
    for (std::size_t i = 0; same && i < a.lights.size(); ++i) {
        same = a.lights[i].direction == b.lights[i].direction &&
               a.lights[i].angular_radius_radians == b.lights[i].angular_radius_radians &&
               a.lights[i].radiance == b.lights[i].radiance;
    }
    return same;
}

class BuiltInSequence : public testing::TestWithParam<std::string> {};

TEST_P(BuiltInSequence, IsAFunctionOfTheImageNumber) {
    const LightingSequence sequence = load_sequence(GetParam());
    EXPECT_EQ(sequence.name, GetParam());
    EXPECT_FALSE(sequence.description.empty());
    std::vector<light::LightRig> forwards;
    for (std::uint32_t i = 0; i < sequence.images; ++i) {
        forwards.push_back(rig_of_image(sequence, {}, i));
    }
    const LightingSequence again = load_sequence(GetParam());
    for (std::uint32_t i = sequence.images; i-- > 0;) {
        EXPECT_TRUE(same_rig(forwards[i], rig_of_image(again, {}, i))) << i;
    }
}

TEST_P(BuiltInSequence, MovesUntilItRestsAndThenNoMore) {
    const LightingSequence sequence = load_sequence(GetParam());
    const std::uint32_t rest = sequence.rests_from();
    ASSERT_GT(rest, 0U);
    const view::Look beginning{.eye = {1, 2, 3}, .look_at = {0, 1, 0}};
    const auto are_same = [&](std::uint32_t a, std::uint32_t b) {
        return same_rig(rig_of_image(sequence, {}, a), rig_of_image(sequence, {}, b)) &&
               look_of_image(sequence, beginning, a) == look_of_image(sequence, beginning, b);
    };
    EXPECT_FALSE(are_same(rest - 1, sequence.images) && rest < sequence.images);
    for (std::uint32_t i = rest; i < sequence.images; ++i) {
        EXPECT_TRUE(are_same(rest, i));
    }
}

TEST_P(BuiltInSequence, GivesLightsThatThereCanBe) {
    const LightingSequence sequence = load_sequence(GetParam());
    for (std::uint32_t i = 0; i < sequence.images; ++i) {
        const light::LightRig rig = rig_of_image(sequence, {}, i);
        EXPECT_GE(rig.blend_amount, 0);
        EXPECT_LE(rig.blend_amount, 1);
        EXPECT_GE(rig.environment_scale.x, 0);
        for (const light::AreaLight& light : rig.lights) {
            EXPECT_NEAR(light.direction.length(), 1, 1e-5);
            EXPECT_GT(light.angular_radius_radians, 0);
            EXPECT_LT(light.angular_radius_radians, 1.5708F);
            EXPECT_GT(light.radiance.x, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         BuiltInSequence,
                         testing::ValuesIn(sequence_names()),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(LightingSequence, SlowFastSlowIsOneTurn) {
    const LightingSequence sequence = load_sequence("slow-fast-slow");
    const light::LightRig first = rig_of_image(sequence, {}, 0);
    const light::LightRig last = rig_of_image(sequence, {}, 149);
    EXPECT_NEAR(std::abs(first.rotation ^ last.rotation), 1, 1e-5);
    EXPECT_EQ(sequence.rests_from(), 100U);
}

TEST(LightingSequence, AnotherSeedIsAnotherRandomSequence) {
    LightingSequence sequence = load_sequence("random-edits");
    const light::LightRig one = rig_of_image(sequence, {}, 0);
    sequence.seed += 1;
    EXPECT_FALSE(same_rig(one, rig_of_image(sequence, {}, 0)));
}

TEST(LightingSequence, RefusesWhatNobodyKnows) {
    nlohmann::json json{{"name", "n"}, {"description", "d"}, {"images", 3}, {"seed", 1}};
    EXPECT_NO_THROW((void)sequence_from_json(json));
    json["speed"] = 3;
    EXPECT_THROW((void)sequence_from_json(json), std::invalid_argument);
    json.erase("speed");
    json["lights"] = {{{"colour", 1}}};
    EXPECT_THROW((void)sequence_from_json(json), std::invalid_argument);
    json.erase("lights");
    json.erase("images");
    EXPECT_THROW((void)sequence_from_json(json), std::invalid_argument);
    EXPECT_THROW((void)load_sequence("no-such-sequence"), std::invalid_argument);
}

}  // namespace
}  // namespace relume::lab
