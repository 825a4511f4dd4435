#include "client/cli/settled_image.h"

#include "client/cli/client_error.h"
#include "tests/unit/cli/crafted_frames.h"
#include "tests/unit/cli/loopback_server.h"

#include <gtest/gtest.h>

namespace relume::cli {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

SettledImageRequest request_to(const LoopbackServer& server) {
    return {
        .connection = {.server = server.url(), .room = "r", .scene = "tiny", .token = "a b"},
        .patch = {{"environment", {{"gain", 2}}}},
        .until_error = std::nullopt,
        .timeout = 20s};
}

std::string failure_of(const SettledImageRequest& request) {
    try {
        static_cast<void>(fetch_settled_image(request));
    } catch (const ClientError& error) {
        return error.what();
    }
    return "nothing failed";
}

// Sends the change that answers the edit just received.
void answer_edit(LoopbackPeer& peer, std::uint64_t revision) {
    const auto message = wire::parse_client_message(peer.receive(), wire::Limits{});
    const auto& edit = std::get<wire::Edit>(message);
    peer.send_text(wire::text_from_message(
        wire::Change{.revision = revision, .patch = edit.patch, .edit_id = edit.id}));
}

TEST(SettledImages, TheFirstExactImageOfTheEditIsTaken) {
    std::vector<std::uint64_t> acknowledged;
    LoopbackServer server([&](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot(5));
        peer.send_binary(tiny_half_frame(5, 1, 0.25F));  // exact, but of the state before
        answer_edit(peer, 6);
        peer.send_binary(tiny_jpeg_frame(6, 2));
        peer.send_binary(tiny_half_frame(6, 3, 0.5F, 0.01F));  // settled, not exact
        peer.send_binary(tiny_half_frame(6, 4, 0.75F));
        for (std::string text = peer.receive(); !text.empty(); text = peer.receive()) {
            const auto message = wire::parse_client_message(text, wire::Limits{});
            acknowledged.push_back(std::get<wire::Ack>(message).sequence);
        }
    });
    const SettledImage settled = fetch_settled_image(request_to(server));
    EXPECT_TRUE(settled.header.exact);
    EXPECT_EQ(settled.header.sequence, 4U);
    EXPECT_EQ(static_cast<float>(settled.image.plane(2)[23]), 0.75F);
    EXPECT_EQ(settled.scene.name, "tiny");
    EXPECT_EQ(settled.state.environment.gain, 2);
    EXPECT_GT(settled.edit_to_image_ms.value(), 0);
    EXPECT_EQ(server.wait_for_request(), "/session/r?images=settled&scene=tiny");
    // Image 1 may be acknowledged before the edit is sent or after; the last one need not be.
    EXPECT_TRUE(acknowledged == (std::vector<std::uint64_t>{1, 2, 3}) ||
                acknowledged == (std::vector<std::uint64_t>{2, 3}) || acknowledged.empty())
        << acknowledged.size();
}

TEST(SettledImages, WithoutAnEditTheStateAsItIsWillDo) {
    LoopbackServer server([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot(5));
        peer.send_binary(tiny_half_frame(5, 1, 0.25F));
        static_cast<void>(peer.receive());
    });
    SettledImageRequest request = request_to(server);
    request.patch = json::object();
    const SettledImage settled = fetch_settled_image(request);
    EXPECT_EQ(settled.header.revision, 5U);
    EXPECT_EQ(settled.edit_to_image_ms, std::nullopt);
}

TEST(SettledImages, AnErrorThatIsLowEnoughWillDo) {
    LoopbackServer server([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot(5));
        answer_edit(peer, 6);
        peer.send_binary(tiny_half_frame(6, 1, 0.5F, 0.1F));
        peer.send_binary(tiny_half_frame(6, 2, 0.5F, 0.01F));
        while (!peer.receive().empty()) {
        }
    });
    SettledImageRequest request = request_to(server);
    request.until_error = 0.01;
    EXPECT_EQ(fetch_settled_image(request).header.sequence, 2U);
}

TEST(SettledImages, MessagesOfTypesUnknownAreSkipped) {
    LoopbackServer server([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot(5));
        peer.send_text(R"({"type":"weather","sun":true})");
        peer.send_text(R"({"type":"viewers","count":3,"names":["a"]})");
        answer_edit(peer, 6);
        peer.send_binary(tiny_half_frame(6, 1, 0.5F));
        static_cast<void>(peer.receive());
    });
    EXPECT_EQ(fetch_settled_image(request_to(server)).header.sequence, 1U);
}

TEST(SettledImages, ARefusedEditFailsWithTheServersWords) {
    LoopbackServer server([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot());
        static_cast<void>(peer.receive());
        peer.send_text(wire::text_from_message(
            wire::message_from_error(wire::WireError(wire::ErrorCode::unknown_name,
                                                     "/environment/name", "\"x\"", "a name")
                                         .with_edit_id(1))));
        static_cast<void>(peer.receive());
    });
    EXPECT_NE(failure_of(request_to(server)).find("unknown_name at /environment/name"),
              std::string::npos);
}

TEST(SettledImages, AClosedConnectionFailsWithItsReason) {
    LoopbackServer server([](LoopbackPeer& peer) { peer.close(4007, "too many rooms"); });
    EXPECT_NE(failure_of(request_to(server)).find("too many rooms"), std::string::npos);
    LoopbackServer mute([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot());
        peer.close(4005, "");
    });
    EXPECT_NE(failure_of(request_to(mute)).find("too many errors"), std::string::npos);
}

TEST(SettledImages, WhatIsNoFrameOfTheProtocolFailsByName) {
    std::vector<std::byte> wrong_magic = tiny_half_frame(6, 1, 1);
    wrong_magic[0] = std::byte{'X'};
    std::vector<std::byte> cut = tiny_half_frame(6, 1, 1);
    cut.pop_back();
    std::vector<std::byte> broken_payload = tiny_half_frame(6, 1, 1);
    broken_payload[wire::kImageHeaderBytes] ^= std::byte{0xFF};
    std::vector<std::byte> other_size = tiny_half_frame(6, 1, 1);
    other_size[8] = std::byte{kTinyWidth + 1};
    struct Case {
        std::vector<std::byte> frame;
        const char* part;
    };
    for (const Case& c : {Case{wrong_magic, "magic"}, Case{cut, "payload_bytes"},
                          Case{broken_payload, "payload"}, Case{other_size, "the room's"}}) {
        LoopbackServer server([&](LoopbackPeer& peer) {
            peer.send_text(tiny_snapshot());
            answer_edit(peer, 6);
            peer.send_binary(c.frame);
            static_cast<void>(peer.receive());
        });
        EXPECT_NE(failure_of(request_to(server)).find(c.part), std::string::npos) << c.part;
    }
    for (const char* text :
         {"{", R"({"type":"snapshot"})", R"({"type":"viewers","count":-1})"}) {
        LoopbackServer server([&](LoopbackPeer& peer) {
            peer.send_text(text);
            static_cast<void>(peer.receive());
        });
        EXPECT_NE(failure_of(request_to(server)).find("the server sent"), std::string::npos)
            << text;
    }
}

TEST(SettledImages, AFrameBeyondTheSceneIsNotReadWhole) {
    LoopbackServer server([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot());
        peer.send_binary(std::vector<std::byte>(std::size_t{3} << 20));
        static_cast<void>(peer.receive());
    });
    EXPECT_NE(failure_of(request_to(server)).find("ended the connection"), std::string::npos);
}

TEST(SettledImages, ASilentServerRunsOutOfTime) {
    LoopbackServer server([](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot());
        while (!peer.receive().empty()) {
        }
    });
    SettledImageRequest request = request_to(server);
    request.timeout = 50ms;
    EXPECT_NE(failure_of(request).find("found no answer to the edit, expected an exact image"),
              std::string::npos);
}

TEST(SettledImages, NoServerAndNoWebSocketAreNamed) {
    SettledImageRequest request;
    {
        const LoopbackServer gone(std::string{});
        request = request_to(gone);
    }
    EXPECT_NE(failure_of(request).find("connecting: Connection refused"), std::string::npos);
    LoopbackServer refusing(
        "HTTP/1.1 404 Not Found\r\nContent-Length: 9\r\nConnection: close\r\n\r\nno scene!");
    EXPECT_NE(failure_of(request_to(refusing)).find("HTTP status 404: no scene!"),
              std::string::npos);
}

}  // namespace
}  // namespace relume::cli
