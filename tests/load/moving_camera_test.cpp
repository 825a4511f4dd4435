// A mesh scene as it is served: the client moves its camera.
#include "tests/load/end_to_end.h"
#include "tests/support/tiny_mesh.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace relume::test {
namespace {

using nlohmann::json;

class MovingCamera : public EndToEnd {
  protected:
    static void SetUpTestSuite() {
        EndToEnd::SetUpTestSuite();
        write_tiny_mesh_transport(folder() / "scenes" / "room.relume");
    }
    static std::vector<std::string> camera_arguments() {
        return {"--eye", "11,20.5,31", "--look-at", "9,19.5,29",
                "--fov", "70",         "--size",    "61x43"};
    }
};

TEST_F(MovingCamera, ACameraAndASizeAreRendered) {
    std::vector<std::string> arguments = camera_arguments();
    arguments.insert(arguments.end(), {"--scene", "room", "--environment", "sky-noon"});
    const json straight = render(arguments, "straight.exr");
    EXPECT_EQ(straight.at("exact"), true);
    EXPECT_EQ(straight.at("width"), 61);
    EXPECT_EQ(straight.at("height"), 43);
    EXPECT_EQ(straight.at("state").at("camera").at("eye"), json({11, 20.5, 31}));

    // In a room that has been looked at from elsewhere, bit for bit.
    static_cast<void>(render({"--scene", "room", "--room", "shared", "--environment",
                              "sky-noon", "--size", "200x10"},
                             "detour.exr"));
    arguments = camera_arguments();
    arguments.insert(arguments.end(), {"--room", "shared"});
    const json detour = render(arguments, "detour.exr");
    EXPECT_EQ(detour.at("coefficients_applied"), 0);
    EXPECT_EQ(pixels_of(folder() / "detour.exr").values,
              pixels_of(folder() / "straight.exr").values);
}

TEST_F(MovingCamera, WhereItStaysTheEditIsRefused) {
    const Answer fixed =
        run({"render", "--scene", "box", "--eye", "0,0,3", "-o", in_folder("box.exr")});
    EXPECT_EQ(fixed.exit_code, 1);
    EXPECT_NE(fixed.errors.find("/camera"), std::string::npos) << fixed.errors;
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"--fov", "180"}, {"--size", "4097x4"}, {"--size", "0x4"}}) {
        std::vector<std::string> arguments{"render", "--scene", "room", "-o",
                                           in_folder("wrong.exr")};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        const Answer refused = run(arguments);
        EXPECT_EQ(refused.exit_code, 1) << wrong[1];
        EXPECT_NE(refused.errors.find("expected"), std::string::npos) << refused.errors;
    }
}

// Of light that rests every image is exact, wherever the camera goes.
TEST_F(MovingCamera, ASequenceOfTheCameraStaysExact) {
    std::ofstream(folder() / "walk.json") << R"({
        "scene": "room", "start": {"environment": {"name": "sky-noon"}},
        "steps": [
            {"rest": {"until": "exact"}},
            {"camera": {"keys": [{"eye": [9, 20.5, 31], "look_at": [10, 20, 30]},
                                 {"eye": [11, 21, 31]}, {"eye": [11, 19, 29]}],
                        "images": 20}},
            {"rest": {"until": "exact"}}]})";
    const Answer answer = run({"sequence", in_folder("walk.json"), "-o", in_folder("walk"),
                               "--json", in_folder("walk-report.json")});
    ASSERT_EQ(answer.exit_code, 0) << answer.errors;
    EXPECT_EQ(json::parse(answer.output).at("edits_shown"), 20);
    std::ifstream file(folder() / "walk-report.json");
    std::size_t of_camera = 0;
    const json report = json::parse(file);
    for (const json& image : report.at("images")) {
        if (image.at("step") == 1) {
            ++of_camera;
            EXPECT_EQ(image.at("exact"), true) << image;
            EXPECT_EQ(image.at("coefficients_applied"), 0) << image;
        }
    }
    EXPECT_GT(of_camera, 2U);
}

}  // namespace
}  // namespace relume::test
