#include "client/cli/edit_options.h"

#include "client/cli/client_error.h"
#include "protocol/base/program/usage.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace relume::cli {
namespace {

using nlohmann::json;

TEST(EditOptions, NothingAskedIsAnEmptyPatch) {
    EXPECT_EQ(patch_from_options({}, ""), json::object());
}

TEST(EditOptions, AllTogether) {
    EditOptions options;
    options.rotate = "90,-5.5,1e1";
    options.lights = {"key:0,1,0:5:10,9,8", "rim:-1,0,0:0.5:1,1,1"};
    options.patch = R"({"display":{"exposure_stops":1}})";
    options.method = "bi";
    options.priority = "area";
    options.budget_ms = 4;
    EXPECT_EQ(patch_from_options(options, "city"), json::parse(R"({
        "environment": {"name": "city"},
        "rotation": {"yaw_degrees": 90, "pitch_degrees": -5.5, "roll_degrees": 10},
        "lights": {
            "key": {"direction": [0,1,0], "angular_radius_degrees": 5, "radiance": [10,9,8]},
            "rim": {"direction": [-1,0,0], "angular_radius_degrees": 0.5, "radiance": [1,1,1]}},
        "strategy": {"method": "bi", "priority": "area"},
        "budget": {"milliseconds": 4},
        "display": {"exposure_stops": 1}})"));
}

TEST(EditOptions, CameraAndSize) {
    EditOptions options;
    options.eye = "-1,2.5,1e3";
    options.fov_degrees = 0.01;
    EXPECT_EQ(patch_from_options(options, ""),
              json::parse(R"({"camera": {"eye": [-1, 2.5, 1000], "fov_degrees": 0.01}})"));
    options.look_at = "0,0,0";
    options.up = "0,0,1";
    options.size = "1920x1080";
    EXPECT_EQ(patch_from_options(options, ""), json::parse(R"({
        "camera": {"eye": [-1, 2.5, 1000], "look_at": [0, 0, 0], "up": [0, 0, 1],
                   "fov_degrees": 0.01},
        "image": {"width": 1920, "height": 1080}})"));
}

TEST(EditOptions, TheOthersAreAppliedOverThePatch) {
    EditOptions options;
    options.lights = {"key:0,1,0:5:10,9,8"};
    options.patch = R"({"lights":{"key":{"gain":2,"angular_radius_degrees":6}}})";
    options.coefficients = 30;
    const json patch = patch_from_options(options, "");
    EXPECT_EQ(patch.at("lights").at("key").at("angular_radius_degrees"), 5);
    EXPECT_EQ(patch.at("lights").at("key").at("gain"), 2);
    EXPECT_EQ(patch.at("lights").at("key").at("direction"), json({0, 1, 0}));
    EXPECT_EQ(patch.at("budget"), json({{"coefficients", 30}}));
}

// As the page exports its lighting; null takes the second map away.
TEST(EditOptions, LightingComesFromAFile) {
    const test::ScratchDirectory scratch;
    const std::string file = (scratch.path() / "lighting.json").string();
    const char* lighting = R"({
        "environment": {"name": "city", "gain": 2, "tint": [1, 1, 1]},
        "blend": {"name": null, "amount": 0},
        "rotation": {"quaternion": [1, 0, 0, 0]},
        "lights": {"key": {"direction": [0, 1, 0], "angular_radius_degrees": 5,
                           "radiance": [10, 10, 10]}},
        "background": {"mode": "transparent"},
        "display": {"exposure_stops": 1, "tone": "linear"}})";
    std::ofstream(file) << lighting;
    EditOptions options;
    options.patch = "@" + file;
    EXPECT_EQ(patch_from_options(options, ""), json::parse(lighting));
    json expected = json::parse(lighting);
    expected["environment"]["name"] = "night";
    EXPECT_EQ(patch_from_options(options, "night"), expected);
}

std::string fault_of(const std::string& patch) {
    try {
        static_cast<void>(patch_from_text(patch));
        return "none";
    } catch (const ClientError& error) {
        return error.what();
    }
}

TEST(EditOptions, FaultsOfThePatchAreNamedByLine) {
    const test::ScratchDirectory scratch;
    const std::string file = (scratch.path() / "lighting.json").string();
    std::ofstream(file) << "{\n  \"display\": {\n    \"tone\": linear\n  }\n}\n";
    EXPECT_EQ(fault_of("@" + file),
              file + ": found line 3, column 13: \"l\", expected JSON in UTF-8");
    EXPECT_EQ(fault_of("[1]"), "--patch: found an array of 1, expected a JSON object");
    std::ofstream(file) << std::string(100'000, '[');
    EXPECT_NE(fault_of("@" + file).find("65536 bytes"), std::string::npos);
    EXPECT_NE(fault_of("@" + scratch.path().string()).find("found a directory"),
              std::string::npos);
}

bool refused(const EditOptions& options) {
    try {
        static_cast<void>(patch_from_options(options, ""));
    } catch (const ClientError&) {
        return true;
    } catch (const program::UsageError&) {
        return true;
    }
    return false;
}

TEST(EditOptions, WrongFormsAreNamed) {
    for (const char* text : {"1,2", "1,2,3,4", "a,b,c", "1,2,", "1 ,2,3", ",,", "1;2;3"}) {
        EditOptions options;
        options.rotate = text;
        EXPECT_TRUE(refused(options)) << text;
    }
    for (const char* text : {"key", "key:0,1,0:5", "key:0,1:5:1,1,1", "key:0,1,0:x:1,1,1",
                             "key:0,1,0:5:1,1,1:2", "key:0,1,0:5,6:1,1,1"}) {
        EditOptions options;
        options.lights = {text};
        EXPECT_TRUE(refused(options)) << text;
    }
    for (const char* text : {"1,2", "1,2,3,4", "up"}) {
        EditOptions eye;
        eye.eye = text;
        EXPECT_TRUE(refused(eye)) << text;
        EditOptions up;
        up.up = text;
        EXPECT_TRUE(refused(up)) << text;
    }
    for (const char* text :
         {"1920", "1920,1080", "x", "1x2x3", "-1x5", "1.5x2", "99999999999x1"}) {
        EditOptions options;
        options.size = text;
        EXPECT_TRUE(refused(options)) << text;
    }
    for (const char* text : {"{", "[]", "1", "{\"a\":1,\"a\":2}", "@/no/such/file"}) {
        EditOptions options;
        options.patch = text;
        EXPECT_TRUE(refused(options)) << text;
    }
}

}  // namespace
}  // namespace relume::cli
