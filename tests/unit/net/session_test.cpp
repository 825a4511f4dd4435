// Sessions over real sockets: what well-meaning clients see.
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

namespace relume::net {
namespace {

using nlohmann::json;

json gain_edit(double gain, std::uint64_t id = 1) {
    return {{"type", "edit"}, {"id", id}, {"patch", {{"environment", {{"gain", gain}}}}}};
}

class SessionTest : public RunningServer {};

TEST_F(SessionTest, BeginsWithTheSnapshotAndConvergesToExact) {
    start();
    WebSocketClient client(port(), "/session/room-1?scene=tiny");
    const auto first = client.receive();
    ASSERT_TRUE(first.has_value());
    ASSERT_FALSE(first->binary);
    const json snapshot = json::parse(first->bytes);
    EXPECT_EQ(snapshot["type"], "snapshot");
    EXPECT_EQ(snapshot["protocol"], 1);
    EXPECT_EQ(snapshot["room"], "room-1");
    EXPECT_EQ(snapshot["scene"]["name"], "tiny");
    EXPECT_EQ(snapshot["revision"], 0);
    EXPECT_EQ(snapshot["state"]["environment"]["name"], "small");
    EXPECT_EQ(snapshot["viewers"], 1);
    EXPECT_EQ(snapshot["limits"]["images_in_flight"], 2);

    const wire::ImageHeader header = client.receive_settled(0).image_header();
    EXPECT_TRUE(header.exact);
    EXPECT_EQ(header.width, 40U);
    EXPECT_EQ(header.height, 24U);
    EXPECT_EQ(header.revision, 0U);
}

TEST_F(SessionTest, EditsComeBackNormalisedAndTheImageHoldsThem) {
    start();
    WebSocketClient client(port(), "/session/r?scene=tiny");
    client.send(
        json{{"type", "edit"}, {"id", 17}, {"patch", {{"rotation", {{"yaw_degrees", 180}}}}}});
    const json change = client.receive_message("change");
    EXPECT_EQ(change["revision"], 1);
    EXPECT_EQ(change["edit_id"], 17);
    EXPECT_EQ(change["patch"]["rotation"]["quaternion"].size(), 4U);
    EXPECT_EQ(client.receive_settled(1).image_header().revision, 1U);
}

TEST_F(SessionTest, TwoClientsSeeTheSameBytesAndALateJoinerToo) {
    start();
    WebSocketClient author(port(), "/session/r?scene=tiny");
    static_cast<void>(author.receive_message("snapshot"));  // now there is a room to join
    WebSocketClient watcher(port(), "/session/r?images=settled");
    author.send(gain_edit(4));
    const WebSocketClient::Frame seen_by_author = author.receive_settled(1);
    const WebSocketClient::Frame seen_by_watcher = watcher.receive_settled(1);
    EXPECT_EQ(seen_by_author.bytes, seen_by_watcher.bytes);

    WebSocketClient late(port(), "/session/r?scene=tiny");
    const json snapshot = late.receive_message("snapshot");
    EXPECT_EQ(snapshot["revision"], 1);
    EXPECT_EQ(snapshot["state"]["environment"]["gain"], 4);
    EXPECT_EQ(snapshot["viewers"], 3);
    std::optional<WebSocketClient::Frame> first_image;
    while (!first_image || !first_image->binary) {
        first_image = late.receive();
        ASSERT_TRUE(first_image.has_value());
    }
    EXPECT_EQ(first_image->bytes, seen_by_author.bytes);
}

TEST_F(SessionTest, SequenceAndRevisionNeverFallAndStatedErrorEndsAtZero) {
    start();
    WebSocketClient client(port(), "/session/r?scene=tiny");
    for (int i = 1; i <= 20; ++i) {
        client.send(gain_edit(i, static_cast<unsigned>(i)));
    }
    wire::ImageHeader last;
    while (!(last.exact && last.revision == 20 &&
             last.encoding == wire::ImageEncoding::half_planes)) {
        const auto frame = client.receive();
        ASSERT_TRUE(frame.has_value());
        if (!frame->binary) {
            continue;
        }
        const wire::ImageHeader header = frame->image_header();
        client.acknowledge(header.sequence);
        EXPECT_GT(header.sequence, last.sequence);
        EXPECT_GE(header.revision, last.revision);
        EXPECT_GE(header.edit_to_image_ms, 0);
        last = header;
    }
    EXPECT_EQ(last.relative_error, 0);
}

TEST_F(SessionTest, ViewersAreCounted) {
    start();
    WebSocketClient first(port(), "/session/r?scene=tiny&images=settled");
    EXPECT_EQ(first.receive_message("viewers")["count"], 1);
    auto second =
        std::make_unique<WebSocketClient>(port(), "/session/r?scene=tiny&images=settled");
    EXPECT_EQ(first.receive_message("viewers")["count"], 2);
    second.reset();
    EXPECT_EQ(first.receive_message("viewers")["count"], 1);
}

TEST_F(SessionTest, MetricsTellWhatHappened) {
    start();
    WebSocketClient client(port(), "/session/r?scene=tiny");
    client.send(gain_edit(2));
    static_cast<void>(client.receive_settled(1));
    EXPECT_TRUE(metrics_say("relume_rooms 1"));
    EXPECT_TRUE(metrics_say("relume_clients 1"));
    EXPECT_TRUE(metrics_say("relume_scenes 1"));
    EXPECT_TRUE(metrics_say("relume_edits_total 1"));
    client.vanish();
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_clients 0"); }));
}

TEST_F(SessionTest, RoomsThatEverybodyLeftAreDropped) {
    configuration_.rooms.linger = std::chrono::milliseconds(20);
    start();
    {
        const WebSocketClient client(port(), "/session/r?scene=tiny");
        EXPECT_TRUE(eventually([&] { return metrics_say("relume_rooms 1"); }));
    }
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_rooms 0"); }));
}

TEST_F(SessionTest, RefusalsHaveTheirCloseCodes) {
    configuration_.token = "secret";
    configuration_.limits.rooms = 1;
    configuration_.limits.clients_per_room = 1;
    start();
    const auto close_code = [this](const std::string& target) {
        return WebSocketClient(port(), target).receive_close();
    };
    EXPECT_EQ(close_code("/session/r?scene=tiny"), 4001U);
    EXPECT_EQ(close_code("/session/r?scene=tiny&token=wrong"), 4001U);
    EXPECT_EQ(close_code("/session/r?scene=none&token=secret"), 4004U);
    EXPECT_EQ(close_code("/session/r?token=secret"), 4004U);
    WebSocketClient inside(port(), "/session/r?scene=tiny&token=secret");
    static_cast<void>(inside.receive_message("snapshot"));
    EXPECT_EQ(close_code("/session/r?scene=tiny&token=secret"), 4003U);
    EXPECT_EQ(close_code("/session/r?scene=other&token=secret"), 4004U);
    EXPECT_EQ(close_code("/session/s?scene=tiny&token=secret"), 4007U);
}

TEST_F(SessionTest, OtherPagesAreRefusedUnlessAllowed) {
    configuration_.allow_origins = {"http://dev.example"};
    start();
    const std::string target = "/session/r?scene=tiny";
    EXPECT_THROW(WebSocketClient(port(), target, {{"Origin", "http://evil.example"}}),
                 std::runtime_error);
    WebSocketClient own(port(), target,
                        {{"Origin", "http://localhost:" + std::to_string(port())}});
    EXPECT_EQ(own.receive_message("snapshot")["room"], "r");
    WebSocketClient allowed(port(), target, {{"Origin", "http://dev.example"}});
    EXPECT_EQ(allowed.receive_message("snapshot")["room"], "r");
}

TEST_F(SessionTest, DrainingFinishesTheImageAndSaysGoodbye) {
    start();
    WebSocketClient client(port(), "/session/r?scene=tiny");
    static_cast<void>(client.receive_settled(0));
    client.send(gain_edit(3));
    static_cast<void>(client.receive_message("change"));
    std::jthread drain([this] { server_->drain(); });
    bool saw_edit = false;
    while (const auto frame = client.receive()) {
        saw_edit = saw_edit || (frame->binary && frame->image_header().revision == 1);
    }
    EXPECT_TRUE(saw_edit);
    EXPECT_EQ(client.receive_close(), 1001U);
    drain.join();
    EXPECT_THROW(WebSocketClient(port(), "/session/r?scene=tiny"), std::exception);
}

}  // namespace
}  // namespace relume::net
