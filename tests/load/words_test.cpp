// What the client says when it is asked for what cannot be, and the words it takes instead.
#include "tests/load/end_to_end.h"
#include "tests/load/pixels.h"

#include <sys/stat.h>

namespace relume::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(EndToEnd, FailuresHaveTheirExitCodeAndTheirWords) {
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        const char* words;
    };
    for (const Case& c : {
             Case{{"render", "--scene", "bxo"}, 1, "did you mean box?"},
             Case{{"render", "--scene", "castle"}, 1, "one of the scenes box, box-sh"},
             Case{{"render", "--scene", "box", "--environment", "sky-noom"},
                  1,
                  "did you mean sky-noon?"},
             Case{{"render", "--scene", "box", "--patch",
                   R"({"environment":{"name":"sky-noom"}})"},
                  1,
                  "did you mean sky-noon?"},
             Case{{"render", "--scene", "box", "--patch", R"({"environment":{"gian":1}})"},
                  1,
                  "did you mean gain?"},
             Case{{"render", "--scene", "box", "--patch", "{\"environment\":\n{]}"},
                  1,
                  "line 2, column 2"},
             Case{{"render", "--scene", "box", "--method", "magic"},
                  1,
                  "out_of_range at /strategy/method"},
             Case{{"render", "--scene", "box", "--light", "key:0,0,0:1:1,1,1"},
                  1,
                  "out_of_range at /lights/key/direction"},
             Case{{"render", "--scene", "box", "--rotate", "1,2"}, 2, "--rotate"},
             Case{{"render", "--scene", "box", "--until-error", "2"}, 2, "--until-error"},
             Case{{"render", "--scene", "box", "--no-such-option"}, 2, "--no-such-option"},
             Case{{"render", "--scene", "box", "--environmant", "sky-noon"},
                  2,
                  "did you mean --environment?"},
             Case{{"rendr", "--scene", "box"}, 2, "did you mean render?"},
             Case{{"render"}, 2, "neither --scene nor --room"},
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

TEST_F(EndToEnd, LightingComesFromAFileAndOptionsGoOverIt) {
    std::ofstream(folder() / "lighting.json") << R"({
        "environment": {"name": "sky-noon", "gain": 2},
        "rotation": {"quaternion": [1, 0, 0, 0]},
        "lights": {"key": {"direction": [1, 1, 0], "angular_radius_degrees": 20,
                           "radiance": [5, 4, 3]}},
        "display": {"exposure_stops": 1, "tone": "linear"}})";
    const std::string file = "@" + in_folder("lighting.json");
    const json by_file = render({"--scene", "box", "--patch", file}, "by-file.exr");
    EXPECT_EQ(by_file.at("state").at("display").at("tone"), "linear");
    static_cast<void>(render({"--scene", "box", "--environment", "sky-noon", "--light",
                              "key:1,1,0:20:5,4,3", "--patch", R"({"environment":{"gain":2}})"},
                             "by-options.exr"));
    EXPECT_EQ(pixels_of(folder() / "by-file.exr").values,
              pixels_of(folder() / "by-options.exr").values);
    const json over = render(
        {"--scene", "box", "--patch", file, "--environment", "sky-overcast"}, "over.exr");
    EXPECT_EQ(over.at("state").at("environment").at("name"), "sky-overcast");
    EXPECT_EQ(over.at("state").at("environment").at("gain"), 2);

    std::ofstream(folder() / "still.json")
        << R"({"scene":"box","steps":[{"rest":{"until":"exact"}}]})";
    const Answer sequence = run({"sequence", in_folder("still.json"), "--patch", file, "-o",
                                 in_folder("still"), "--images", "exr", "--progress"});
    ASSERT_EQ(sequence.exit_code, 0) << sequence.errors;
    const Answer load = run({"load", "--scene", "box", "--patch", file, "--sessions", "1",
                             "--rate", "20", "--seconds", "0.5", "--progress"});
    ASSERT_EQ(load.exit_code, 0) << load.errors;
    EXPECT_NE(load.errors.find("of 1 connections shown"), std::string::npos) << load.errors;
}

TEST_F(EndToEnd, WhatCannotBeWrittenIsSaidBeforeTheServerIsAsked) {
    fs::create_directory(folder() / "taken.exr");
    for (const char* output : {"taken.exr", "no/such/folder.exr"}) {
        const Answer answer = run({"render", "--scene", "none", "-o", in_folder(output)});
        EXPECT_EQ(answer.exit_code, 1);
        EXPECT_EQ(answer.errors.find("scene"), std::string::npos) << answer.errors;
    }
}

// Opening a pipe that nobody writes to waits for ever.
TEST_F(EndToEnd, APipeInItsFoldersHoldsNoServer) {
    for (const char* place : {"odd/pipe.relume", "odd-maps", "odd-page"}) {
        fs::create_directories(folder() / place);
    }
    fs::copy(folder() / "scenes" / "box.relume", folder() / "odd" / "box.relume",
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::ofstream(folder() / "odd-page" / "index.html") << "<p>a page";
    for (const char* pipe :
         {"odd/pipe.relume/manifest.json", "odd-maps/pipe.hdr", "odd-page/pipe.js"}) {
        ASSERT_EQ(::mkfifo((folder() / pipe).c_str(), 0600), 0) << pipe;
    }
    const fs::path port_file = folder() / "odd-port";
    Program odd(
        RELUME_SERVER,
        {"--scenes", in_folder("odd"), "--environments", in_folder("odd-maps"), "--web-root",
         in_folder("odd-page"), "--listen", "127.0.0.1:0", "--port-file", port_file.string()},
        folder(), "odd-server");
    while (!fs::exists(port_file)) {
        ASSERT_TRUE(odd.is_running()) << odd.errors();
        std::this_thread::sleep_for(kPoll);
    }
    std::string port;
    std::ifstream(port_file) >> port;
    std::string scenes;
    while (scenes.find("box") == std::string::npos) {
        ASSERT_TRUE(odd.is_running()) << odd.errors();
        Program client(RELUME_CLIENT, {"scenes", "--server", "127.0.0.1:" + port}, folder(),
                       "odd-client");
        static_cast<void>(client.wait());
        scenes = client.output();
    }
    EXPECT_EQ(scenes.find("pipe"), std::string::npos) << scenes;
    for (const char* event : {"event=scene_broken", "event=environment_broken"}) {
        const std::string errors = odd.errors();
        const std::size_t line = errors.find(event);
        ASSERT_NE(line, std::string::npos) << errors;
        EXPECT_NE(
            errors.substr(line, errors.find('\n', line) - line).find("found a named pipe"),
            std::string::npos)
            << errors;
    }
    odd.send(SIGTERM);
    EXPECT_EQ(odd.wait(), 0);
    EXPECT_EQ(Program(RELUME_BAKE, {"verify", in_folder("odd/pipe.relume")}, folder(), "verify")
                  .wait(),
              1);
}

}  // namespace
}  // namespace relume::test
