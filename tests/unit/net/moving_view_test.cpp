// Where the camera can move, an edit of the view costs no relighting, and what is exact stays
// so.
#include "protocol/wire/room_patch.h"
#include "server/net/rooms/relighter.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_mesh.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

class MovingViewTest : public testing::Test {
  protected:
    MovingViewTest() {
        test::write_tiny_mesh_transport(folder_.path() / "room.relume");
        scenes_.refresh(folder_.path());
        environments_.add_upload("grey",
                                 {{16, 8, std::vector<float>(std::size_t{3} * 16 * 8, 0.5F)},
                                  light::Projection::lat_long});
        const wire::SceneSummary scene = scenes_.find("room")->summary();
        state_.camera = *scene.camera;
        state_.image = {.width = scene.width, .height = scene.height};
        state_.environment.name = "grey";
        relighter_.emplace(scenes_.find("room"), metrics_, std::chrono::seconds(1));
        edit({{"lights",
               {{"key",
                 {{"direction", {0.3, 1, 0.2}},
                  {"angular_radius_degrees", 20},
                  {"radiance", {9, 8, 7}}}}}}},
             kAllStages);
        relight(*relighter_);
    }

    void give_state(Relighter& relighter, wire::Stages stages) {
        EXPECT_TRUE(relighter
                        .set_state(state_,
                                   {.environment = environments_.find("grey"), .blend = {}}, {},
                                   stages)
                        .empty());
    }
    void edit(const json& patch, wire::Stages stages) {
        wire::apply_patch(state_, patch, {});
        give_state(*relighter_, stages);
    }
    void edit(const json& patch) { edit(patch, wire::stages_of(patch)); }
    static void relight(Relighter& relighter) {
        Relighter* const self = &relighter;
        while (!self->at_rest()) {
            Relighter::advance_together({&self, 1});
        }
    }
    // All bits of the half image.
    static std::vector<std::uint16_t> picture(Relighter& relighter, bool settled) {
        ImageStamp stamp;
        stamp.settled = settled;
        const Picture picture =
            relighter.picture(stamp, {.displays = {}, .half_planes = true}, 0);
        EXPECT_TRUE(picture.header.exact);
        EXPECT_EQ(picture.header.width, picture.composer->half_image().width);
        std::vector<std::uint16_t> bits;
        for (const auto value : picture.composer->half_image().values) {
            EXPECT_TRUE(std::isfinite(float{value}));
            bits.push_back(value.bits());
        }
        return bits;
    }
    std::vector<std::uint16_t> picture(bool settled) { return picture(*relighter_, settled); }

    test::ScratchDirectory folder_;
    SceneLibrary scenes_;
    EnvironmentLibrary environments_{EnvironmentBounds{}};
    Metrics metrics_;
    wire::RoomState state_;
    std::optional<Relighter> relighter_;
};

TEST_F(MovingViewTest, TheSceneSaysWhereRoomsBeginAndWhatTheyMayEdit) {
    const wire::SceneSummary scene = scenes_.find("room")->summary();
    EXPECT_EQ(scene.kind, "mesh");
    EXPECT_EQ(scene.width, 40U);
    EXPECT_EQ(scene.height, 24U);
    ASSERT_TRUE(scene.camera);
    EXPECT_LT((scene.camera->eye - Imath::V3d(9, 20.8, 31.2)).length(), 1e-5);
    // It looks along −Z, and meets the wall there or the box in front of it.
    EXPECT_NEAR(scene.camera->look_at.x, 9, 1e-5);
    EXPECT_LT(scene.camera->look_at.z, 31);
    EXPECT_NEAR(scene.camera->fov_degrees, 2 * std::atan(0.6) * 180 / M_PI, 1e-4);
    ASSERT_TRUE(scene.bounds);
    EXPECT_LT((scene.bounds->centre - Imath::V3d(10, 20, 30)).length(), 1e-5);
    EXPECT_NEAR(scene.bounds->radius, 2 * std::sqrt(3.0), 1e-5);
    for (const char* section : {"camera", "image"}) {
        EXPECT_EQ(std::count(scene.edits.begin(), scene.edits.end(), section), 1) << section;
    }
}

// The law: bit for bit through a thousand edits of the view.
TEST_F(MovingViewTest, ExactStaysExactThroughAThousandEditsOfTheView) {
    const std::vector<std::uint16_t> moving = picture(false);
    const std::vector<std::uint16_t> settled = picture(true);
    EXPECT_NE(settled, moving);
    const wire::RoomState beginning = state_;
    const std::uint64_t slices = metrics_.slices();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-4, 4);
    std::uniform_int_distribution<int> side(1, 60);
    std::uniform_real_distribution<double> fov(0.01, 179);
    const auto near = [&] {
        return json{10 + place(random), 20 + place(random), 30 + place(random)};
    };
    for (int i = 0; i < 1000; ++i) {
        json patch = {
            {"camera", {{"eye", near()}, {"look_at", near()}, {"fov_degrees", fov(random)}}}};
        if (i % 3 == 0) {
            patch["image"] = {{"width", side(random)}, {"height", side(random)}};
        }
        if (i % 7 == 0) {
            patch["background"] = {{"mode", i % 2 == 0 ? "transparent" : "environment"}};
        }
        edit(patch);
        ASSERT_TRUE(relighter_->at_rest()) << patch;
        ASSERT_TRUE(relighter_->step_is_complete()) << patch;
        if (i % 4 == 0) {
            static_cast<void>(picture(i % 16 == 0));
        }
    }
    EXPECT_EQ(metrics_.slices(), slices);
    state_ = beginning;
    give_state(*relighter_, wire::Stage::view);
    EXPECT_EQ(picture(false), moving);
    EXPECT_EQ(picture(true), settled);
    // As who has never looked from elsewhere sees it.
    Relighter other(scenes_.find("room"), metrics_, std::chrono::seconds(1));
    give_state(other, kAllStages);
    relight(other);
    EXPECT_EQ(picture(other, true), settled);
}

// Blocks that a view does not see are passed by while light moves. When it turns to them they
// are as for who has looked there all the time.
TEST_F(MovingViewTest, WhatIsPassedByIsMadeUpFor) {
    const json here = {{"camera", {{"eye", {10, 20.5, 30}}, {"look_at", {12, 20.5, 30}}}}};
    const json away = {{"camera", {{"eye", {10, 20.5, 30}}, {"look_at", {8, 20.5, 30}}}}};
    // What is chosen depends on the light alone.
    edit({{"strategy", {{"method", "bi"}, {"priority", "area"}}},
          {"budget", {{"coefficients", 5}}}});
    edit(here);
    Relighter steady(scenes_.find("room"), metrics_, std::chrono::seconds(1));
    give_state(steady, kAllStages);
    relight(steady);
    const auto step = [](Relighter& relighter) {
        Relighter* const self = &relighter;
        Relighter::advance_together({&self, 1});
    };
    const auto image = [](Relighter& relighter) {
        const Picture picture = relighter.picture({}, {.displays = {}, .half_planes = true}, 0);
        EXPECT_FALSE(picture.header.exact);
        return picture.composer->half_image().values;
    };
    for (const double yaw : {30.0, 70.0, 140.0}) {
        edit(away);
        edit({{"lights", {{"key", {{"direction", {yaw, 40, 25}}}}}}});
        step(*relighter_);
        edit(here);
        give_state(steady, wire::Stage::signal);
        step(steady);
        const auto found = image(*relighter_);
        const auto expected = image(steady);
        ASSERT_EQ(found.size(), expected.size());
        float largest = 0;
        for (const half value : expected) {
            largest = std::max(largest, std::abs(float{value}));
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(float{found[i]}, float{expected[i]}, 1e-3F * largest) << yaw;
        }
    }
}

// New light while the camera moves shows in the next image.
TEST_F(MovingViewTest, LightAndViewMoveAtOnce) {
    const json there = {{"eye", {9.2, 20.5, 30.9}}, {"look_at", {10.4, 19.4, 30.2}}};
    edit({{"camera", there}, {"lights", {{"key", {{"gain", 0.25}}}}}});
    EXPECT_FALSE(relighter_->at_rest());
    relight(*relighter_);
    const std::vector<std::uint16_t> found = picture(true);
    Relighter other(scenes_.find("room"), metrics_, std::chrono::seconds(1));
    give_state(other, kAllStages);
    relight(other);
    EXPECT_EQ(picture(other, true), found);
}

// From outside, the room's walls show their backs: nothing. The sky is seen, and coverage says
// so.
TEST_F(MovingViewTest, WhereNothingIsTheBackgroundShows) {
    edit({{"camera", {{"eye", {10, 20, 60}}, {"look_at", {10, 20, 80}}}},
          {"background", {{"mode", "colour"}, {"colour", {0.25, 0.5, 1}}}}});
    const std::size_t pixels = std::size_t{40} * 24;
    const std::vector<std::uint16_t> bits = picture(true);
    ASSERT_EQ(bits.size(), 3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        EXPECT_EQ(bits[i], half(0.25F).bits());
        EXPECT_EQ(bits[2 * pixels + i], half(1.0F).bits());
    }
    edit({{"background", {{"mode", "transparent"}}}});
    const std::vector<std::uint16_t> clear = picture(true);
    ASSERT_EQ(clear.size(), 4 * pixels);
    EXPECT_TRUE(
        std::all_of(clear.begin(), clear.end(), [](std::uint16_t b) { return b == 0; }));
}

}  // namespace
}  // namespace relume::net
