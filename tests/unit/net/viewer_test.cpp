// Over real sockets: what well-meaning viewers see.
#include "protocol/wire/half_image.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

json gain_edit(double gain, std::uint64_t id = 1) {
    return {{"type", "edit"}, {"id", id}, {"patch", {{"environment", {{"gain", gain}}}}}};
}

class ViewerTest : public RunningServer {};

TEST_F(ViewerTest, BeginsWithTheSnapshotAndConvergesToExact) {
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

TEST_F(ViewerTest, EditsComeBackNormalisedAndTheImageHoldsThem) {
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

TEST_F(ViewerTest, TwoClientsSeeTheSameBytesAndALateJoinerToo) {
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

TEST_F(ViewerTest, SequenceAndRevisionNeverFallAndStatedErrorEndsAtZero) {
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

TEST_F(ViewerTest, ATokenMayComeInAHeaderOrAsASubprotocol) {
    configuration_.token = "secret";
    start();
    const std::string target = "/session/r?scene=tiny&images=settled";
    const auto is_let_in = [&](const WebSocketClient::Fields& fields) {
        WebSocketClient client(port(), target, fields);
        const auto first = client.receive();
        return first.has_value() && json::parse(first->bytes)["type"] == "snapshot";
    };
    EXPECT_FALSE(is_let_in({}));
    EXPECT_TRUE(is_let_in({{"Authorization", "Bearer secret"}}));
    EXPECT_TRUE(is_let_in({{"Sec-WebSocket-Protocol", "relume.v1, relume.token.c2VjcmV0"}}));
    EXPECT_FALSE(is_let_in({{"Sec-WebSocket-Protocol", "relume.v1"}}));
    EXPECT_THROW(is_let_in({{"Sec-WebSocket-Protocol", "relume.v2"}}), std::runtime_error);
}

struct MovingImage {
    wire::ImageHeader header;
    wire::HalfImage image;
};

// All images of a revision, the exact one last.
std::vector<MovingImage> images_until_exact(WebSocketClient& client, std::uint64_t revision) {
    std::vector<MovingImage> images;
    while (images.empty() || !images.back().header.exact) {
        const auto frame = client.receive();
        if (!frame) {
            throw std::runtime_error("the connection ended before an exact image");
        }
        if (!frame->binary) {
            continue;
        }
        const wire::ImageHeader header = frame->image_header();
        client.acknowledge(header.sequence);
        EXPECT_EQ(header.encoding, wire::ImageEncoding::half_planes);
        if (header.revision == revision) {
            const auto payload =
                std::as_bytes(std::span(frame->bytes)).subspan(wire::kImageHeaderBytes);
            images.push_back(
                {header, wire::decode_half_image(payload, header.width, header.height,
                                                 header.has_alpha)});
        }
    }
    return images;
}

double squared_relative_l2(const wire::HalfImage& image, const wire::HalfImage& exact) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < std::size_t{3} * exact.width * exact.height; ++i) {
        const double e = double{exact.values[i]};
        const double d = double{image.values[i]} - e;
        difference += d * d;
        norm += e * e;
    }
    return difference / norm;
}

// From outside: the errors that are stated of a drag's images are those they have.
TEST_F(ViewerTest, FloatsWhileMovingHaveTheStatedErrors) {
    start();
    WebSocketClient client(port(), "/session/r?scene=tiny&images=moving-float");
    double stated_squares = 0;
    double true_squares = 0;
    std::size_t moving = 0;
    for (std::uint64_t revision = 1; revision <= 12; ++revision) {
        client.send(json{{"type", "edit"},
                         {"id", revision},
                         {"patch",
                          {{"budget", {{"coefficients", 3}}},
                           {"background", {{"mode", "transparent"}}},
                           {"lights",
                            {{"key",
                              {{"direction",
                                {std::sin(1.1 * static_cast<double>(revision)), 0.4,
                                 std::cos(1.1 * static_cast<double>(revision))}},
                               {"angular_radius_degrees", 25},
                               {"radiance", {9, 8, 7}}}}}}}}});
        const std::vector<MovingImage> images = images_until_exact(client, revision);
        for (const MovingImage& shown : std::span(images).first(images.size() - 1)) {
            stated_squares += std::pow(double{shown.header.relative_error}, 2);
            true_squares += squared_relative_l2(shown.image, images.back().image);
            ++moving;
        }
    }
    ASSERT_GE(moving, 6U);
    // One estimate varies, and the images of a dozen lights together hardly do.
    EXPECT_LT(true_squares, 2 * stated_squares);
    EXPECT_LT(stated_squares, 2 * true_squares);
}

TEST_F(ViewerTest, EveryViewerHasADisplayOfHisOwn) {
    // Long enough for an image of the edit before the settled one, which is no JPEG.
    configuration_.rooms.room.settle_delay = std::chrono::milliseconds(500);
    start();
    WebSocketClient dark(port(), "/session/r?scene=tiny");
    static_cast<void>(dark.receive_message("snapshot"));
    WebSocketClient plain(port(), "/session/r");
    static_cast<void>(plain.receive_message("snapshot"));
    static_cast<void>(dark.receive_settled(0));
    static_cast<void>(plain.receive_settled(0));
    dark.send(json{{"type", "display"}, {"exposure_stops", -20}});
    dark.send(json{{"type", "display"}, {"exposure_stops", -21}});
    EXPECT_EQ(dark.receive_message("error")["path"], "/exposure_stops");
    dark.send(gain_edit(2));
    const auto jpeg_of = [](WebSocketClient& client) {
        while (const auto frame = client.receive()) {
            if (frame->binary && frame->image_header().encoding == wire::ImageEncoding::jpeg) {
                return frame->bytes;
            }
        }
        return std::string();
    };
    const std::string of_dark = jpeg_of(dark);
    const std::string of_plain = jpeg_of(plain);
    EXPECT_NE(of_dark.substr(wire::kImageHeaderBytes),
              of_plain.substr(wire::kImageHeaderBytes));
    // A black picture takes next to nothing.
    EXPECT_LT(of_dark.size(), of_plain.size());
}

// The room's display is an edit, but of nothing that is relit.
TEST_F(ViewerTest, AnEditOfTheDisplayLosesNoExactness) {
    start();
    WebSocketClient client(port(), "/session/r?scene=tiny");
    static_cast<void>(client.receive_settled(0));
    client.send(json{{"type", "edit"},
                     {"id", 1},
                     {"patch", {{"display", {{"exposure_stops", 1}, {"tone", "linear"}}}}}});
    bool settled = false;
    while (!settled) {
        const auto frame = client.receive();
        ASSERT_TRUE(frame.has_value());
        if (!frame->binary) {
            continue;
        }
        const wire::ImageHeader header = frame->image_header();
        client.acknowledge(header.sequence);
        EXPECT_TRUE(header.exact);
        EXPECT_EQ(header.coefficients_applied, 0U);
        settled = header.encoding == wire::ImageEncoding::half_planes && header.revision == 1;
    }
}

TEST_F(ViewerTest, ViewersAreCounted) {
    start();
    WebSocketClient first(port(), "/session/r?scene=tiny&images=settled");
    EXPECT_EQ(first.receive_message("viewers")["count"], 1);
    auto second =
        std::make_unique<WebSocketClient>(port(), "/session/r?scene=tiny&images=settled");
    EXPECT_EQ(first.receive_message("viewers")["count"], 2);
    second.reset();
    EXPECT_EQ(first.receive_message("viewers")["count"], 1);
}

TEST_F(ViewerTest, MetricsTellWhatHappened) {
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

TEST_F(ViewerTest, RoomsThatEverybodyLeftAreDropped) {
    configuration_.rooms.linger = std::chrono::milliseconds(20);
    start();
    {
        const WebSocketClient client(port(), "/session/r?scene=tiny");
        EXPECT_TRUE(eventually([&] { return metrics_say("relume_rooms 1"); }));
    }
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_rooms 0"); }));
}

TEST_F(ViewerTest, RefusalsHaveTheirCloseCodes) {
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

TEST_F(ViewerTest, OtherPagesAreRefusedUnlessAllowed) {
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

TEST_F(ViewerTest, DrainingFinishesTheImageAndSaysGoodbye) {
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
