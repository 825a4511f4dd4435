// An edit runs again the stages that it concerns, and no other.
#include "server/net/rooms/relighter.h"

#include "protocol/wire/room_patch.h"
#include "tests/unit/net/exact_picture.h"
#include "tests/unit/net/tiny_scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

class RelighterTest : public testing::Test {
  protected:
    RelighterTest() {
        scenes_.refresh(folder_.path());
        environments_.add_upload("grey",
                                 {{16, 8, std::vector<float>(std::size_t{3} * 16 * 8, 0.5F)},
                                  light::Projection::lat_long});
        relighter_.emplace(scenes_.find("tiny"), metrics_, std::chrono::seconds(1));
        edit({{"environment", {{"name", "grey"}}},
              {"lights",
               {{"key",
                 {{"direction", {0.3, 1, 0.2}},
                  {"angular_radius_degrees", 20},
                  {"radiance", {9, 8, 7}}}}}}},
             kAllStages);
        relight();
        shown_ = picture();
    }

    void edit(const json& patch, wire::Stages stages) {
        wire::apply_patch(state_, patch, {});
        EXPECT_TRUE(relighter_
                        ->set_state(state_,
                                    {.environment = environments_.find("grey"), .blend = {}},
                                    {}, stages)
                        .empty());
    }
    void edit(const json& patch) { edit(patch, wire::stages_of(patch)); }
    void relight() {
        Relighter* const self = &*relighter_;
        while (!self->at_rest()) {
            Relighter::advance_together({&self, 1});
        }
    }
    // All bits of the half image.
    std::vector<std::uint16_t> picture() { return exact_picture(*relighter_); }
    // How often it has been measured what new light takes.
    [[nodiscard]] int measured_lightings() const {
        const std::string name = "relume_lighting_seconds_count ";
        const std::string text = metrics_.text();
        return std::stoi(text.substr(text.find("\n" + name) + 1 + name.size()));
    }
    void expect_no_relighting(const json& patch) {
        const int lightings = measured_lightings();
        const std::uint64_t slices = metrics_.slices();
        edit(patch);
        EXPECT_TRUE(relighter_->at_rest()) << patch;
        EXPECT_TRUE(relighter_->step_is_complete()) << patch;
        relight();
        EXPECT_EQ(measured_lightings(), lightings) << patch;
        EXPECT_EQ(metrics_.slices(), slices) << patch;
    }

    TinyScenes folder_;
    Metrics metrics_;
    SceneLibrary scenes_;
    EnvironmentLibrary environments_{EnvironmentBounds{}};
    wire::RoomState state_;
    std::optional<Relighter> relighter_;
    std::vector<std::uint16_t> shown_;
};

TEST_F(RelighterTest, ADisplayIsNoLightAndLeavesEveryBitOfTheLinearImage) {
    const std::uint64_t pixels = relighter_->pixels();
    expect_no_relighting({{"display", {{"exposure_stops", 2}}}});
    EXPECT_EQ(relighter_->pixels(), pixels);
    EXPECT_TRUE(relighter_->image_changed()) << "a JPEG of it differs";
    EXPECT_EQ(picture(), shown_);
}

TEST_F(RelighterTest, PolicyChangesNoImage) {
    const std::uint64_t pixels = relighter_->pixels();
    expect_no_relighting({{"budget", {{"coefficients", 7}}}});
    expect_no_relighting({{"strategy", {{"method", "bi"}}}});
    EXPECT_EQ(relighter_->pixels(), pixels);
    EXPECT_FALSE(relighter_->image_changed());
    EXPECT_EQ(picture(), shown_);
}

TEST_F(RelighterTest, WhatIsBehindTheSceneIsComposedAnewAndNotRelit) {
    const std::uint64_t pixels = relighter_->pixels();
    expect_no_relighting({{"background", {{"mode", "colour"}, {"colour", {3, 2, 1}}}}});
    EXPECT_NE(relighter_->pixels(), pixels);
    EXPECT_NE(picture(), shown_);
}

TEST_F(RelighterTest, LightThatIsWhatItWasIsNotRelit) {
    expect_no_relighting({{"lights", {{"key", {{"name", "Window"}, {"order", 3}}}}}});
    expect_no_relighting({{"environment", {{"gain", 1}}}});
    EXPECT_FALSE(relighter_->image_changed());
}

TEST_F(RelighterTest, NewLightIsMeasuredAndRelit) {
    const int lightings = measured_lightings();
    edit({{"environment", {{"gain", 2}}}});
    EXPECT_FALSE(relighter_->at_rest());
    EXPECT_EQ(measured_lightings(), lightings + 1);
    relight();
    EXPECT_NE(picture(), shown_);
    // And the way back is the way there.
    edit({{"environment", {{"gain", 1}}}});
    relight();
    EXPECT_EQ(picture(), shown_);
}

}  // namespace
}  // namespace relume::net
