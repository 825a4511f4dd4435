// What mute and solo do to the image: the light's linear law holds for the parts.
#include "protocol/wire/room_patch.h"
#include "server/net/library/environment_library.h"
#include "server/net/rooms/relighter.h"
#include "tests/unit/net/tiny_scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

light::EnvironmentMap grey_map() {
    light::MapImage image{.width = 16, .height = 8, .rgb = {}};
    image.rgb.assign(std::size_t{3} * image.width * image.height, 0.5F);
    return {std::move(image), light::Projection::lat_long};
}

const json kTwoLights = {
    {"environment", {{"name", "grey"}}},
    {"lights",
     {{"key",
       {{"direction", {0.3, 1, 0.2}}, {"angular_radius_degrees", 20}, {"radiance", {9, 8, 7}}}},
      {"rim",
       {{"direction", {-1, 0.4, 0.1}},
        {"angular_radius_degrees", 30},
        {"radiance", {1, 2, 3}}}}}}};

class LightSwitches : public testing::Test {
  protected:
    LightSwitches() {
        scenes_.refresh(folder_.path());
        environments_.add_upload("grey", grey_map());
    }

    // The exact image, linear, of two lights and an environment with these switches, a patch of
    // `lights`. The background is the environment where `background` says so, else black.
    std::vector<float> image_with(const json& switches,
                                  const char* background = "colour") const {
        wire::RoomState state;
        apply_patch(state, kTwoLights, wire::Limits{});
        apply_patch(state,
                    {{"lights", switches},
                     {"background", {{"mode", background}, {"colour", {0, 0, 0}}}}},
                    wire::Limits{});
        Metrics metrics;
        Relighter relighter(scenes_.find("tiny"), metrics, std::chrono::seconds(1));
        EXPECT_TRUE(
            relighter
                .set_state(state, {.environment = environments_.find("grey"), .blend = nullptr},
                           {}, kAllStages)
                .empty());
        Relighter* const self = &relighter;
        while (!relighter.at_rest()) {
            Relighter::advance_together(std::span(&self, 1));
        }
        const Picture picture =
            relighter.picture({}, {.displays = {}, .half_planes = true}, /*jpeg_quality=*/80);
        EXPECT_TRUE(picture.header.exact);
        std::vector<float> linear;
        for (std::size_t c = 0; c < 3; ++c) {
            for (const auto value : picture.composer->half_image().plane(c)) {
                linear.push_back(static_cast<float>(value));
            }
        }
        return linear;
    }

    static double norm(const std::vector<float>& image) {
        double squares = 0;
        for (const float x : image) {
            squares += double{x} * x;
        }
        return std::sqrt(squares);
    }

  private:
    TinyScenes folder_;
    SceneLibrary scenes_;
    EnvironmentLibrary environments_{EnvironmentBounds{}};
};

TEST_F(LightSwitches, EachAloneAddUpToAllTogether) {
    const std::vector<float> all = image_with(json::object());
    const std::vector<float> key = image_with({{"key", {{"solo", true}}}});
    const std::vector<float> rim = image_with({{"rim", {{"solo", true}}}});
    const std::vector<float> environment =
        image_with({{"key", {{"muted", true}}}, {"rim", {{"muted", true}}}});
    for (const auto* part : {&key, &rim, &environment}) {
        EXPECT_GT(norm(*part), 0.01 * norm(all));
    }
    std::vector<float> off = all;
    for (std::size_t i = 0; i < all.size(); ++i) {
        off[i] -= key[i] + rim[i] + environment[i];
    }
    EXPECT_LT(norm(off), 2e-3 * norm(all));  // four roundings to half floats
}

TEST_F(LightSwitches, AMutedLightIsOneOfGainZero) {
    EXPECT_EQ(image_with({{"key", {{"muted", true}}}}), image_with({{"key", {{"gain", 0}}}}));
    EXPECT_EQ(image_with({{"key", {{"muted", true}}}}), image_with({{"key", nullptr}}));
}

TEST_F(LightSwitches, TwoSoloLightsAreTheImageWithoutTheEnvironment) {
    const json both = {{"key", {{"solo", true}}}, {"rim", {{"solo", true}}}};
    const std::vector<float> all = image_with(json::object());
    const std::vector<float> lights = image_with(both);
    const std::vector<float> environment =
        image_with({{"key", {{"muted", true}}}, {"rim", {{"muted", true}}}});
    std::vector<float> off = all;
    for (std::size_t i = 0; i < all.size(); ++i) {
        off[i] -= lights[i] + environment[i];
    }
    EXPECT_LT(norm(off), 2e-3 * norm(all));
}

TEST_F(LightSwitches, MuteWinsOverSoloAndSoloStillDarkensTheRest) {
    const json muted_solo = {{"key", {{"muted", true}, {"solo", true}}}};
    EXPECT_EQ(norm(image_with(muted_solo)), 0);
    // What lies behind the scene is the environment as it lights: dark too.
    EXPECT_EQ(norm(image_with(muted_solo, "environment")), 0);
    EXPECT_GT(norm(image_with(json::object(), "environment")), 0);
}

TEST_F(LightSwitches, NamesAndOrderAreNotLight) {
    EXPECT_EQ(image_with({{"key", {{"name", "Window"}, {"order", 7}}}}),
              image_with(json::object()));
}

}  // namespace
}  // namespace relume::net
