// The programs as they are delivered: a scene is baked, served, and looked at by the client.
#include "tests/load/pixels.h"
#include "tests/support/program.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

namespace relume::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::chrono::milliseconds kPoll{20};

struct Answer {
    int exit_code;
    std::string output;
    std::string errors;
};

class EndToEnd : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        scratch_ = std::make_unique<ScratchDirectory>();
        fs::create_directory(folder() / "scenes");
        fs::create_directory(folder() / "environments");
        bake("box", {});
        bake("box-sh", {"--basis", "sh", "--order", "10"});
        write_environment(folder() / "sun.hdr");
    }
    static void TearDownTestSuite() { scratch_.reset(); }

    void SetUp() override {
        const fs::path port_file = folder() / "port";
        fs::remove(port_file);
        server_ = std::make_unique<Program>(
            RELUME_SERVER,
            std::vector<std::string>{"--scenes", (folder() / "scenes").string(),
                                     "--environments", (folder() / "environments").string(),
                                     "--listen", "127.0.0.1:0", "--port-file",
                                     port_file.string()},
            folder(), "server");
        while (!fs::exists(port_file)) {
            ASSERT_TRUE(server_->is_running()) << server_->errors() << server_->output();
            std::this_thread::sleep_for(kPoll);
        }
        std::ifstream(port_file) >> port_;
        while (run({"info"}).output.find("ready                   true") == std::string::npos) {
            ASSERT_TRUE(server_->is_running()) << server_->errors() << server_->output();
            std::this_thread::sleep_for(kPoll);
        }
    }

    // Whatever a test did to it, the server ends in good order.
    void TearDown() override {
        server_->send(SIGTERM);
        EXPECT_EQ(server_->wait(), 0) << server_->errors() << server_->output();
    }

    // The built-in box into the folder that is served.
    static void bake(const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--builtin",
                                           "box",
                                           "--size",
                                           "72x40",
                                           "--light-resolution",
                                           "8",
                                           "--bounces",
                                           "1",
                                           "--samples",
                                           "8",
                                           "-o",
                                           (folder() / "scenes" / (name + ".relume")).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        static_cast<void>(run_to_end(RELUME_BAKE, arguments, folder(), "bake"));
    }

    static const fs::path& folder() { return scratch_->path(); }
    static std::string in_folder(const char* name) { return (folder() / name).string(); }

    [[nodiscard]] std::vector<std::string> with_server(
        std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--server", "http://127.0.0.1:" + port_});
        return arguments;
    }
    [[nodiscard]] Answer run(const std::vector<std::string>& arguments) const {
        Program client(RELUME_CLIENT, with_server(arguments), folder(), "client");
        const int exit_code = client.wait();
        return {exit_code, client.output(), client.errors()};
    }
    // Renders to a linear image and returns what `--json` says; the run must succeed.
    [[nodiscard]] json render(std::vector<std::string> arguments, const char* file) const {
        arguments.insert(arguments.begin(), {"render", "--json", "-o", in_folder(file)});
        const Answer answer = run(arguments);
        if (answer.exit_code != 0) {
            throw std::runtime_error(answer.errors);
        }
        return json::parse(answer.output);
    }

    Program& server() { return *server_; }

  private:
    static std::unique_ptr<ScratchDirectory> scratch_;
    std::unique_ptr<Program> server_;
    std::string port_;
};

std::unique_ptr<ScratchDirectory> EndToEnd::scratch_;

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

TEST_F(EndToEnd, FailuresHaveTheirExitCodeAndTheirWords) {
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        const char* words;
    };
    for (const Case& c : {
             Case{{"render", "--scene", "none"}, 1, "unknown scene"},
             Case{{"render", "--scene", "box", "--environment", "none"},
                  1,
                  "unknown_name at /environment/name"},
             Case{{"render", "--scene", "box", "--method", "magic"},
                  1,
                  "out_of_range at /strategy/method"},
             Case{{"render", "--scene", "box", "--light", "key:0,0,0:1:1,1,1"},
                  1,
                  "out_of_range at /lights/key/direction"},
             Case{{"render", "--scene", "box", "--rotate", "1,2"}, 1, "--rotate"},
             Case{{"render", "--scene", "box", "--until-error", "2"}, 2, "--until-error"},
             Case{{"render", "--scene", "box", "--no-such-option"}, 2, "--no-such-option"},
         }) {
        std::vector<std::string> arguments = c.arguments;
        arguments.insert(arguments.end(), {"-o", in_folder("failure.exr")});
        const Answer answer = run(arguments);
        EXPECT_EQ(answer.exit_code, c.exit_code) << answer.errors;
        EXPECT_NE((answer.errors + answer.output).find(c.words), std::string::npos)
            << answer.errors << answer.output;
        EXPECT_FALSE(fs::exists(folder() / "failure.exr"));
    }
    EXPECT_EQ(render({"--scene", "box"}, "after.exr").at("exact"), true);
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
    EXPECT_NE(client.errors().find("shutting down"), std::string::npos) << client.errors();
}

}  // namespace
}  // namespace relume::test
