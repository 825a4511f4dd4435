#include "protocol/wire/stages.h"

#include "protocol/wire/room_state.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

using nlohmann::json;

TEST(Stages, EachSectionTouchesItsOwn) {
    const json lights = {{"lights", {{"key", {{"gain", 2}}}}}};
    EXPECT_EQ(stages_of(lights), Stage::signal);
    EXPECT_EQ(stages_of({{"environment", {{"gain", 2}}}}), Stage::signal);
    EXPECT_EQ(stages_of({{"blend", {{"amount", 1}}}}), Stage::signal);
    EXPECT_EQ(stages_of({{"rotation", {{"yaw_degrees", 1}}}}), Stage::signal);
    EXPECT_EQ(stages_of({{"background", {{"mode", "colour"}}}}), Stage::view);
    EXPECT_EQ(stages_of({{"camera", {{"fov_degrees", 20}}}}), Stage::view);
    EXPECT_EQ(stages_of({{"image", {{"width", 640}}}}), Stage::view);
    EXPECT_EQ(stages_of({{"display", {{"tone", "linear"}}}}), Stage::display);
    EXPECT_EQ(stages_of({{"strategy", {{"method", "bi"}}}}), Stage::policy);
    EXPECT_EQ(stages_of({{"budget", {{"milliseconds", 4}}}}), Stage::policy);
}

TEST(Stages, APatchTouchesThoseOfAllItsSections) {
    const Stages stages =
        stages_of({{"display", {{"tone", "linear"}}}, {"lights", {{"key", nullptr}}}});
    EXPECT_EQ(stages, Stage::display | Stage::signal);
    EXPECT_TRUE(stages.has(Stage::signal));
    EXPECT_FALSE(stages.has(Stage::policy));
    EXPECT_TRUE(stages_of(json::object()).empty());
}

TEST(Stages, NoSectionIsWithoutOne) {
    const json state = to_json(RoomState{});
    for (const auto& [key, section] : state.items()) {
        EXPECT_FALSE(stages_of({{key, section}}).empty()) << key;
    }
}

}  // namespace
}  // namespace relume::wire
