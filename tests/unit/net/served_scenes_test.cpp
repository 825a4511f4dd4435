// Scenes as clients find them: listed, followed, and unhurt by what is done to their files.
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

using ServedScenes = RunningServer;

TEST_F(ServedScenes, ListsScenesAndServesOnBesideABrokenOne) {
    fs::copy(scenes_.path() / "tiny.relume", scenes_.path() / "broken.relume",
             fs::copy_options::recursive);
    fs::resize_file(scenes_.path() / "broken.relume/shards/00000.shard", 100);
    start();
    const json scenes = json::parse(http(port(), "GET", "/api/scenes").body)["scenes"];
    ASSERT_EQ(scenes.size(), 1U);
    EXPECT_EQ(scenes[0]["name"], "tiny");
    EXPECT_EQ(scenes[0]["width"], 40);
    EXPECT_EQ(scenes[0]["height"], 24);
    EXPECT_EQ(scenes[0]["face_resolution"], 8);
    EXPECT_EQ(scenes[0]["kind"], "image");
    EXPECT_EQ(scenes[0]["basis"], "haar");
    EXPECT_EQ(scenes[0]["columns"], 6 * 8 * 8);
    EXPECT_GT(scenes[0]["memory_bytes"], scenes[0]["bytes"]);
    EXPECT_FALSE(scenes[0]["edits"].empty());
    EXPECT_GT(scenes[0]["bytes"], 1000);
    expect_serves_on();
}

// In place, as no careful program would: the copy that is served does not change.
TEST_F(ServedScenes, AServedSceneThatIsChangedInPlaceHurtsNobody) {
    start();
    const fs::path scene = scenes_.path() / "tiny.relume";
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(scene)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    for (const fs::path& path : files) {
        const std::string zeroes(fs::file_size(path), '\xFF');
        std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << zeroes;
    }
    expect_serves_on();
    for (const fs::path& path : files) {
        fs::resize_file(path, 0);
    }
    expect_serves_on();
}

TEST_F(ServedScenes, ScenesThatComeChangeAndGoAreFollowed) {
    configuration_.scenes_interval = std::chrono::milliseconds(20);
    start();
    const auto widths = [this] {
        std::map<std::string, int> found;
        const json listing = json::parse(http(port(), "GET", "/api/scenes").body);
        for (const json& scene : listing["scenes"]) {
            found[scene["name"]] = scene["width"];
        }
        return found;
    };
    using Widths = std::map<std::string, int>;
    const fs::path other = scenes_.path() / "elsewhere";
    test::write_tiny_transport(other, {.width = 16});
    fs::rename(other, scenes_.path() / "other.relume");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"other", 16}, {"tiny", 40}}; }));

    // Somebody is in a room of it while it is replaced, and stays there.
    WebSocketClient inside(port(), "/session/old?scene=other");
    static_cast<void>(inside.receive_settled(0));
    test::write_tiny_transport(other, {.width = 24});
    fs::rename(scenes_.path() / "other.relume", scenes_.path() / "away");
    fs::rename(other, scenes_.path() / "other.relume");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"other", 24}, {"tiny", 40}}; }));
    inside.send(json{{"type", "edit"}, {"id", 1}, {"patch", {{"environment", {{"gain", 2}}}}}});
    EXPECT_EQ(inside.receive_settled(1).image_header().width, 16U);
    WebSocketClient outside(port(), "/session/new?scene=other");
    EXPECT_EQ(outside.receive_settled(0).image_header().width, 24U);
    inside.vanish();
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_rooms 1"); }));

    fs::remove_all(scenes_.path() / "other.relume");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"tiny", 40}}; }));
    EXPECT_EQ(WebSocketClient(port(), "/session/newer?scene=other").receive_close(), 4004U);
    outside.send(
        json{{"type", "edit"}, {"id", 1}, {"patch", {{"environment", {{"gain", 2}}}}}});
    EXPECT_EQ(outside.receive_settled(1).image_header().width, 24U);

    // A broken one is left out until it is whole.
    fs::copy(scenes_.path() / "tiny.relume", other, fs::copy_options::recursive);
    fs::rename(other / "columns.bin", scenes_.path() / "columns.bin");
    fs::rename(other, scenes_.path() / "late.relume");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(widths(), (Widths{{"tiny", 40}}));
    fs::rename(scenes_.path() / "columns.bin", scenes_.path() / "late.relume/columns.bin");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"late", 40}, {"tiny", 40}}; }));
    expect_serves_on();
}

TEST_F(ServedScenes, PicturesAreServedIfTheBakeLeftThem) {
    start();
    fs::create_directory(scenes_.path() / "tiny.relume/view");
    for (const std::string file : {"thumbnail.png", "materials.png"}) {
        const std::string path = "/api/scenes/tiny/" + file;
        EXPECT_EQ(http(port(), "GET", path).status, 404U);
        EXPECT_EQ(http(port(), "GET", "/api/scenes/none/" + file).status, 404U);
        EXPECT_NE(http(port(), "GET", "/api/scenes/tinny/" + file).body.find("mean tiny?"),
                  std::string::npos);
        std::ofstream(scenes_.path() / "tiny.relume/view" / file) << file;
        const HttpAnswer answer = http(port(), "GET", path);
        EXPECT_EQ(answer.status, 200U);
        EXPECT_EQ(answer.body, file);
        EXPECT_NE(answer.head.find("Content-Type: image/png"), std::string::npos);
    }
    EXPECT_EQ(http(port(), "GET", "/api/scenes/tiny/albedo.exr").status, 404U);
}

}  // namespace
}  // namespace relume::net
