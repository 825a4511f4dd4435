#include "client/cli/sequence_script.h"

#include "client/cli/client_error.h"
#include "protocol/wire/room_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>

namespace relume::cli {
namespace {

using nlohmann::json;

std::string message_for(const std::string& text) {
    try {
        static_cast<void>(sequence_script_from_text(text));
    } catch (const ClientError& error) {
        return error.what();
    }
    return "nothing was refused";
}

std::string with_step(const std::string& step) {
    return R"({"steps":[)" + step + "]}";
}

// The script that the README shows.
std::string documented_script() {
    std::ifstream file(RELUME_CLI_README);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::smatch match;
    if (!std::regex_search(text, match, std::regex("```json\n([^`]*)```"))) {
        throw std::runtime_error(RELUME_CLI_README ": holds no JSON example");
    }
    return match[1];
}

TEST(SequenceScripts, TheDocumentedOneIsTakenAndAServerWouldTakeItsEdits) {
    const SequenceScript script = sequence_script_from_text(documented_script());
    EXPECT_EQ(script.scene, "table");
    ASSERT_EQ(script.steps.size(), 7U);
    wire::RoomState state;
    wire::apply_patch(state, script.start, wire::Limits{});
    for (const Step& step : script.steps) {
        for (std::uint32_t i = 0; i < edit_count(step); ++i) {
            EXPECT_NO_THROW(wire::apply_patch(state, patch_of(step, i), wire::Limits{}));
        }
    }
    EXPECT_EQ(state.blend.amount, 1);
    EXPECT_EQ(state.camera.eye, Imath::V3d(4, 3, -3));
    EXPECT_EQ(state.camera.look_at, Imath::V3d(0, 1, 0));
    EXPECT_EQ(state.camera.fov_degrees, 20);
    EXPECT_EQ(state.budget.coefficients, 30U);
    const Imath::V3d end = Imath::V3d(1, 0.3, 0).normalized();
    EXPECT_TRUE(state.lights.at("key").direction.equalWithAbsError(end, 1e-12));
}

TEST(SequenceScripts, AMaterialGoesFromOneStateToAnother) {
    const SequenceScript script = sequence_script_from_text(with_step(
        R"({"material": {"id": "pearl", "shape": "ggx", "roughness": [0.3, 0.1],
                         "diffuse": [[1, 1, 1], [0, 1, 3]], "images": 3}})"));
    const Step& step = script.steps.at(0);
    ASSERT_EQ(edit_count(step), 3U);
    const auto pearl = [&](std::uint32_t i) {
        return patch_of(step, i).at("materials").at("pearl");
    };
    EXPECT_EQ(pearl(0),
              json::parse(R"({"shape": "ggx", "roughness": 0.3, "diffuse": [1,1,1]})"));
    EXPECT_DOUBLE_EQ(pearl(1).at("roughness"), 0.2);
    EXPECT_EQ(pearl(1).at("diffuse"), json({0.5, 1.0, 2.0}));
    EXPECT_DOUBLE_EQ(pearl(2).at("roughness"), 0.1);
}

TEST(SequenceScripts, AMaterialThatIsWrongIsNamed) {
    const auto refused = [](const std::string& material) {
        return message_for(with_step(R"({"material": )" + material + "}"));
    };
    const std::string nothing = refused(R"({"id": "pearl", "images": 2})");
    EXPECT_NE(nothing.find("nothing that changes"), std::string::npos) << nothing;
    EXPECT_NE(nothing.find("roughness"), std::string::npos) << nothing;
    const std::string one = refused(R"({"id": "pearl", "roughness": [0.1], "images": 2})");
    EXPECT_NE(one.find("/steps/0/material/roughness"), std::string::npos) << one;
    const std::string high = refused(R"({"id": "pearl", "f90": [0, 2], "images": 2})");
    EXPECT_NE(high.find("/steps/0/material/f90/1"), std::string::npos) << high;
    const std::string shape =
        refused(R"({"id": "pearl", "shape": "gx", "roughness": [0.1, 0.2], "images": 2})");
    EXPECT_NE(shape.find("ggx"), std::string::npos) << shape;
    EXPECT_NE(refused(R"({"id": "pearl", "gloss": [0, 1], "f90": [0, 1], "images": 2})")
                  .find("gloss"),
              std::string::npos);
}

TEST(SequenceScripts, FaultsAreNamedByPlace) {
    struct Case {
        std::string text;
        const char* part;
    };
    for (const Case& c : {
             Case{"", "malformed_json"},
             Case{"[]", "wrong_type"},
             Case{"{}", "missing_field at /steps"},
             Case{R"({"steps":[]})", "at /steps"},
             Case{R"({"steps":{}})", "at /steps"},
             Case{R"({"steps":[{"rest":{"until":"exact"}}],"speed":1})", "at /speed"},
             Case{R"({"scene":"a/b","steps":[{"rest":{"until":1}}]})", "at /scene"},
             Case{R"({"start":1,"steps":[{"rest":{"until":1}}]})", "at /start"},
             Case{with_step("{}"), "at /steps/0: found 0 kinds"},
             Case{with_step(R"({"rest":{"until":1},"patch":{}})"),
                  "at /steps/0: found 2 kinds"},
             Case{with_step(R"({"spin":{}})"), "unknown_field at /steps/0/spin"},
             Case{with_step(R"({"rotate":{"yaw_degrees":[0,1]}})"),
                  "at /steps/0/rotate/images"},
             Case{with_step(R"({"rotate":{"images":0}})"), "at /steps/0/rotate/images"},
             Case{with_step(R"({"rotate":{"images":2.5}})"), "at /steps/0/rotate/images"},
             Case{with_step(R"({"rotate":{"images":2,"yaw_degrees":5}})"),
                  "at /steps/0/rotate/yaw_degrees"},
             Case{with_step(R"({"rotate":{"images":2,"yaw_degrees":[5]}})"),
                  "at /steps/0/rotate/yaw_degrees"},
             Case{with_step(R"({"rotate":{"images":2,"yaw_degrees":[5,1e7]}})"),
                  "at /steps/0/rotate/yaw_degrees/1"},
             Case{with_step(R"({"rotate":{"images":2,"ease":"fast"}})"),
                  "at /steps/0/rotate/ease"},
             Case{with_step(
                      R"({"move_light":{"id":"k","from":[0,0,0],"to":[0,1,0],"images":2}})"),
                  "at /steps/0/move_light/from"},
             Case{with_step(R"({"move_light":{"from":[0,1,0],"to":[0,1,0],"images":2}})"),
                  "at /steps/0/move_light/id"},
             Case{with_step(R"({"blend":{"name":"n","images":2}})"),
                  "at /steps/0/blend/amount"},
             Case{with_step(R"({"blend":{"name":"n","amount":[0,2],"images":2}})"),
                  "at /steps/0/blend/amount/1"},
             Case{with_step(R"({"camera":{"images":2}})"), "at /steps/0/camera/keys"},
             Case{with_step(
                      R"({"camera":{"images":2,"keys":[{"eye":[0,0,0],"look_at":[1,0,0]}]}})"),
                  "at /steps/0/camera/keys"},
             Case{with_step(R"({"camera":{"images":2,"keys":[{"eye":[0,0,0]},{}]}})"),
                  "at /steps/0/camera/keys/0/look_at"},
             Case{with_step(R"({"camera":{"images":2,"keys":[{"eye":[0,0,0],"look_at":[1,0,0]},
                                {"fov_degrees":40}]}})"),
                  "missing_field at /steps/0/camera/keys/1/fov_degrees"},
             Case{with_step(R"({"camera":{"images":2,"keys":[{"eye":[0,0,0],"look_at":[1,0,0],
                                "fov_degrees":180},{}]}})"),
                  "out_of_range at /steps/0/camera/keys/0/fov_degrees"},
             Case{with_step(R"({"rest":{}})"), "at /steps/0/rest/until"},
             Case{with_step(R"({"rest":{"until":"done"}})"), "at /steps/0/rest/until"},
             Case{with_step(R"({"rest":{"until":-1}})"), "at /steps/0/rest/until"},
             Case{with_step(R"({"patch":[]})"), "at /steps/0/patch"},
         }) {
        EXPECT_NE(message_for(c.text).find(c.part), std::string::npos)
            << c.text << "\n  said: " << message_for(c.text);
    }
}

TEST(SequenceScripts, EasesRunFromZeroToOneWithoutTurningBack) {
    for (const Ease ease :
         {Ease::linear, Ease::slow_fast_slow, Ease::slow_fast, Ease::fast_slow}) {
        EXPECT_EQ(eased(ease, 0), 0);
        EXPECT_EQ(eased(ease, 1), 1);
        double previous = 0;
        for (int i = 1; i <= 1000; ++i) {
            const double way = eased(ease, i / 1000.0);
            EXPECT_GE(way, previous);
            previous = way;
        }
    }
    EXPECT_LT(eased(Ease::slow_fast_slow, 0.1), 0.05);
    EXPECT_NEAR(eased(Ease::slow_fast_slow, 0.5), 0.5, 1e-12);
    EXPECT_LT(eased(Ease::slow_fast, 0.5), 0.5);
    EXPECT_GT(eased(Ease::fast_slow, 0.5), 0.5);
}

TEST(SequenceScripts, AMotionStartsAndEndsWhereItSays) {
    const Step rotate = Rotate{.yaw_degrees = {.from = 10, .to = 100},
                               .pitch_degrees = {},
                               .roll_degrees = {},
                               .images = 4,
                               .ease = Ease::linear};
    EXPECT_EQ(patch_of(rotate, 0).at("rotation").at("yaw_degrees"), 10);
    EXPECT_EQ(patch_of(rotate, 1).at("rotation").at("yaw_degrees"), 40);
    EXPECT_EQ(patch_of(rotate, 3).at("rotation").at("yaw_degrees"), 100);
    const Step jump = Rotate{.yaw_degrees = {.from = 10, .to = 100},
                             .pitch_degrees = {},
                             .roll_degrees = {},
                             .images = 1,
                             .ease = Ease::linear};
    EXPECT_EQ(patch_of(jump, 0).at("rotation").at("yaw_degrees"), 100);
}

TEST(SequenceScripts, ALightMovesOnAGreatCircle) {
    const auto direction = [](const Step& step, std::uint32_t i) {
        const json d = patch_of(step, i).at("lights").at("k").at("direction");
        return Imath::V3d(d[0], d[1], d[2]);
    };
    const Step quarter = MoveLight{
        .id = "k", .from = {1, 0, 0}, .to = {0, 1, 0}, .images = 3, .ease = Ease::linear};
    EXPECT_TRUE(direction(quarter, 0).equalWithAbsError({1, 0, 0}, 1e-12));
    EXPECT_TRUE(
        direction(quarter, 1).equalWithAbsError({std::sqrt(0.5), std::sqrt(0.5), 0}, 1e-12));
    EXPECT_TRUE(direction(quarter, 2).equalWithAbsError({0, 1, 0}, 1e-12));
    const Step across = MoveLight{
        .id = "k", .from = {1, 0, 0}, .to = {-1, 0, 0}, .images = 5, .ease = Ease::linear};
    for (std::uint32_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(direction(across, i).length(), 1, 1e-12);
        EXPECT_NEAR(direction(across, i).x, std::cos(i * 3.14159265358979 / 4), 1e-9);
    }
    const Step still = MoveLight{
        .id = "k", .from = {0, 0, 1}, .to = {0, 0, 1}, .images = 2, .ease = Ease::linear};
    EXPECT_TRUE(direction(still, 0).equalWithAbsError({0, 0, 1}, 1e-12));
}

Imath::V3d triple(const json& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

TEST(SequenceScripts, ACameraPassesThroughItsKeysAndRunsStraightWhereTheyDo) {
    const CameraPath path = camera_path_from_json(json::parse(R"([
        {"eye": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 2, 0], "fov_degrees": 10},
        {"eye": [1, 0, 0]},
        {"eye": [2, 0, 0], "up": [1, 0, 0]},
        {"eye": [3, 0, 0], "fov_degrees": 40}])"),
                                                  "");
    for (int i = 0; i <= 3; ++i) {
        const json camera = path.patch_at(i / 3.0).at("camera");
        EXPECT_LT((triple(camera.at("eye")) - Imath::V3d(i, 0, 0)).length(), 1e-12);
    }
    const json middle = path.patch_at(0.5).at("camera");
    EXPECT_LT((triple(middle.at("eye")) - Imath::V3d(1.5, 0, 0)).length(), 1e-12);
    EXPECT_LT((triple(middle.at("look_at")) - Imath::V3d(0, 0, -1)).length(), 1e-12);
    EXPECT_LT((triple(middle.at("up")) - Imath::V3d(0.5, 0.5, 0)).length(), 1e-12);
    EXPECT_NEAR(path.patch_at(5.0 / 6).at("camera").at("fov_degrees").get<double>(), 20, 1e-9);
    EXPECT_EQ(path.patch_at(1).at("camera").at("fov_degrees"), 40);
    // What no key states stays as it is in the room.
    const CameraPath bare = camera_path_from_json(
        json::parse(R"([{"eye": [0, 0, 0], "look_at": [0, 0, -1]}, {"eye": [1, 0, 0]}])"), "");
    EXPECT_FALSE(bare.patch_at(0.5).at("camera").contains("up"));
    EXPECT_FALSE(bare.patch_at(0.5).at("camera").contains("fov_degrees"));
}

}  // namespace
}  // namespace relume::cli
