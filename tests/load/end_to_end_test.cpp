// The programs as they are delivered: a scene is baked, served, and looked at by the client.
#include "tests/load/end_to_end.h"

#include "tests/load/pixels.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

namespace relume::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(EndToEnd, ListingsShowWhatIsServed) {
    const json scenes = json::parse(run({"scenes", "--json"}).output);
    ASSERT_EQ(scenes.size(), 2U);
    EXPECT_EQ(scenes[0].at("name"), "box");
    EXPECT_EQ(scenes[1].at("name"), "box-sh");
    for (const json& scene : scenes) {
        EXPECT_EQ(scene.at("width"), 72);
        EXPECT_EQ(scene.at("height"), 40);
        EXPECT_EQ(scene.at("face_resolution"), 8);
    }
    const json info = json::parse(run({"info", "--json"}).output);
    EXPECT_EQ(info.at("limits").at("message_bytes"), 65536);
    const Answer table = run({"environments"});
    EXPECT_EQ(table.exit_code, 0);
    EXPECT_NE(table.output.find("procedural"), std::string::npos);
}

TEST_F(EndToEnd, AnExactImageIsTheSameFromWhateverHistory) {
    const json straight =
        render({"--scene", "box", "--environment", in_folder("sun.hdr"), "--rotate", "30,10,5"},
               "straight.exr");
    EXPECT_EQ(straight.at("exact"), true);
    EXPECT_EQ(straight.at("relative_error"), 0);
    EXPECT_EQ(straight.at("coefficients_remaining"), 0);

    // By way of other lights and methods, in a room that others share.
    static_cast<void>(render({"--scene", "box", "--room", "shared", "--environment", "sky-noon",
                              "--light", "key:1,1,0:20:5,4,3", "--method", "bi"},
                             "detour.exr"));
    const json detour = render(
        {"--room", "shared", "--environment", in_folder("sun.hdr"), "--rotate", "390,10,5",
         "--patch", R"({"lights":{"key":null}})", "--method", "nwa", "--coefficients", "7"},
        "detour.exr");
    EXPECT_EQ(detour.at("exact"), true);
    EXPECT_LE(
        relative_l2(pixels_of(folder() / "straight.exr"), pixels_of(folder() / "detour.exr")),
        1e-3);  // half floats

    // Who comes later, and edits nothing, sees that very image.
    static_cast<void>(render({"--room", "shared"}, "later.exr"));
    EXPECT_EQ(pixels_of(folder() / "later.exr").values,
              pixels_of(folder() / "detour.exr").values);
}

TEST_F(EndToEnd, LightIsLinear) {
    const std::string sun = in_folder("sun.hdr");
    const std::string off = R"({"environment":{"gain":0}})";
    const std::vector<std::string> light = {"--light", "key:0.4,1,0.3:15:9,8,7"};
    static_cast<void>(render({"--scene", "box", "--environment", sun}, "one.exr"));
    static_cast<void>(render(
        {"--scene", "box", "--environment", sun, "--patch", R"({"environment":{"gain":2}})"},
        "two.exr"));
    static_cast<void>(
        render({"--scene", "box", "--environment", sun, "--patch", off, light[0], light[1]},
               "light.exr"));
    static_cast<void>(
        render({"--scene", "box", "--environment", sun, light[0], light[1]}, "sum.exr"));
    const Pixels one = pixels_of(folder() / "one.exr");
    EXPECT_LE(relative_l2(one, pixels_of(folder() / "two.exr"), 2), 1e-3);
    Pixels sum = one;
    const Pixels lit = pixels_of(folder() / "light.exr");
    for (std::size_t i = 0; i < sum.values.size(); ++i) {
        sum.values[i] += lit.values[i];
    }
    EXPECT_LE(relative_l2(sum, pixels_of(folder() / "sum.exr")), 1e-3);
    EXPECT_GT(relative_l2(one, pixels_of(folder() / "sum.exr")),
              0.05);  // the light does something
}

TEST_F(EndToEnd, AFileIsUploadedOnceAndABrokenOneRefusedByName) {
    for (int times = 0; times < 2; ++times) {
        static_cast<void>(
            render({"--scene", "box", "--environment", in_folder("sun.hdr")}, "upload.exr"));
    }
    const json environments = json::parse(run({"environments", "--json"}).output);
    EXPECT_EQ(std::count_if(environments.begin(), environments.end(),
                            [](const json& e) { return e.at("kind") == "upload"; }),
              1);

    std::ofstream(folder() / "broken.hdr")
        << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9 +X 99999\n";
    const Answer answer = run({"render", "--scene", "box", "--environment",
                               in_folder("broken.hdr"), "-o", in_folder("broken.exr")});
    EXPECT_EQ(answer.exit_code, 1);
    EXPECT_NE(answer.errors.find("found"), std::string::npos) << answer.errors;
    EXPECT_FALSE(fs::exists(folder() / "broken.exr"));
    EXPECT_EQ(render({"--scene", "box"}, "after.exr").at("exact"), true);
}

TEST_F(EndToEnd, TransparencyIsCoverageAndPngIsShown) {
    static_cast<void>(
        render({"--scene", "box", "--patch", R"({"background":{"mode":"transparent"}})"},
               "alpha.exr"));
    const Pixels linear = pixels_of(folder() / "alpha.exr");
    ASSERT_EQ(linear.channels, 4);
    for (std::size_t i = 3; i < linear.values.size(); i += 4) {
        EXPECT_GE(linear.values[i], 0);
        EXPECT_LE(linear.values[i], 1);
    }
    static_cast<void>(render({"--scene", "box"}, "shown.png"));
    EXPECT_EQ(pixels_of(folder() / "shown.png").channels, 3);
}

TEST_F(EndToEnd, AnErrorThatSufficesIsStatedAndHeld) {
    const json summary = render({"--scene", "box", "--environment", in_folder("sun.hdr"),
                                 "--coefficients", "2", "--until-error", "0.1"},
                                "near.exr");
    EXPECT_LE(summary.at("relative_error").get<double>(), 0.1);
}

TEST_F(EndToEnd, ASequenceShowsEveryEditAndEndsExact) {
    std::ofstream(folder() / "script.json") << R"({
        "scene": "box", "start": {"budget": {"coefficients": 20}},
        "steps": [
            {"rotate": {"yaw_degrees": [0, 90], "images": 20, "ease": "slow-fast-slow"}},
            {"rest": {"until": "exact"}},
            {"patch": {"lights": {"key": {"direction": [0, 1, 0], "angular_radius_degrees": 9,
                                          "radiance": [9, 8, 7]}}}},
            {"move_light": {"id": "key", "from": [0, 1, 0], "to": [1, 1, 0], "images": 10}},
            {"blend": {"name": "sky-noon", "amount": [0, 1], "images": 10}},
            {"rest": {"until": "exact"}}]})";
    const Answer answer =
        run({"sequence", in_folder("script.json"), "-o", in_folder("images"), "--images", "exr",
             "--rate", "60", "--csv", in_folder("s.csv"), "--json", in_folder("s.json")});
    ASSERT_EQ(answer.exit_code, 0) << answer.errors;
    const json summary = json::parse(answer.output);
    EXPECT_EQ(summary.at("edits"), 41);
    EXPECT_EQ(summary.at("edits_shown"), 41);
    EXPECT_EQ(summary.at("exact"), true);
    std::ifstream file(folder() / "s.json");
    const json report = json::parse(file);
    std::uint64_t sequence = 0;
    std::uint64_t revision = 0;
    for (const json& image : report.at("images")) {
        EXPECT_TRUE(fs::exists(folder() / "images" / image.at("file").get<std::string>()));
        EXPECT_GT(image.at("sequence").get<std::uint64_t>(), sequence);
        EXPECT_GE(image.at("revision").get<std::uint64_t>(), revision);
        sequence = image.at("sequence");
        revision = image.at("revision");
    }
    EXPECT_EQ(report.at("images").size(), summary.at("images"));
}

TEST_F(EndToEnd, ManyRoomsAreServedAtOnce) {
    const Answer answer = run({"load", "--scene", "box", "--sessions", "6", "--idle", "3",
                               "--rate", "20", "--seconds", "1", "--budget-ms", "4"});
    ASSERT_EQ(answer.exit_code, 0) << answer.errors << answer.output;
    const json result = json::parse(answer.output);
    EXPECT_EQ(result.at("opened"), 9);
    EXPECT_GE(result.at("stated_error_p50"), 0);
    EXPECT_LT(result.at("stated_error_p50"), 1) << "images of a drag hold more than black";
    EXPECT_GT(result.at("edits"), 0);
    EXPECT_EQ(result.at("edits_shown"), result.at("edits"));
}

TEST_F(EndToEnd, SphericalHarmonicsAreServedAsWaveletsAre) {
    const Answer load =
        run({"load", "--scene", "box-sh", "--sessions", "2", "--rate", "20", "--seconds", "1"});
    ASSERT_EQ(load.exit_code, 0) << load.errors << load.output;
    const json dragged = json::parse(load.output);
    EXPECT_GT(dragged.at("images"), 0);
    EXPECT_EQ(dragged.at("edits_shown"), dragged.at("edits"));

    // By way of a sun, few terms an image, to the end.
    const std::vector<std::string> smooth{"--environment", "sky-overcast"};
    static_cast<void>(render({"--scene", "box-sh", "--room", "rings", "--environment",
                              in_folder("sun.hdr"), "--until-error", "0.5"},
                             "rings.exr"));
    const json detour = render(
        {"--room", "rings", "--until-error", "0", "--coefficients", "7", smooth[0], smooth[1]},
        "harmonics.exr");
    EXPECT_EQ(detour.at("exact"), true);
    static_cast<void>(render({"--scene", "box-sh", smooth[0], smooth[1]}, "straight.exr"));
    EXPECT_EQ(pixels_of(folder() / "harmonics.exr").values,
              pixels_of(folder() / "straight.exr").values);

    // What an overcast sky holds beyond order 10, and the noise of eight paths, are little.
    static_cast<void>(render({"--scene", "box", smooth[0], smooth[1]}, "wavelets.exr"));
    EXPECT_LE(relative_l2(pixels_of(folder() / "wavelets.exr"),
                          pixels_of(folder() / "harmonics.exr")),
              0.05);
}

TEST_F(EndToEnd, AServerThatIsToldToStopSaysSo) {
    std::ofstream(folder() / "long.json")
        << R"({"scene":"box","steps":[{"rotate":{"yaw_degrees":[0,9000],"images":100000}}]})";
    const fs::path images = folder() / "long";
    Program client(RELUME_CLIENT,
                   with_server({"sequence", in_folder("long.json"), "-o", images.string()}),
                   folder(), "long");
    while (!fs::exists(images / "image_00003.jpg")) {
        ASSERT_TRUE(client.is_running()) << client.errors();
        std::this_thread::sleep_for(kPoll);
    }
    server().send(SIGTERM);
    EXPECT_EQ(client.wait(), 1);
    // By the connection's end, or by the code of an edit that came before it.
    EXPECT_TRUE(client.errors().find("shutting down") != std::string::npos ||
                client.errors().find("shutting_down") != std::string::npos)
        << client.errors();
}

}  // namespace
}  // namespace relume::test
