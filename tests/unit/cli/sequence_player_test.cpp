#include "client/cli/sequence_player.h"

#include "client/cli/client_error.h"
#include "tests/unit/cli/crafted_frames.h"
#include "tests/unit/cli/loopback_server.h"

#include <gtest/gtest.h>

namespace relume::cli {
namespace {

using nlohmann::json;

// Answers every edit with a change and one image; an exact one when it is the last of `edits`.
void play_server(LoopbackPeer& peer, std::size_t edits, std::vector<json>& patches) {
    peer.send_text(tiny_snapshot(0));
    std::uint64_t sequence = 0;
    peer.send_binary(tiny_half_frame(0, ++sequence, 0.1F));
    for (std::string text = peer.receive(); !text.empty(); text = peer.receive()) {
        const auto message = wire::parse_client_message(text, wire::Limits{});
        if (const auto* edit = std::get_if<wire::Edit>(&message)) {
            patches.push_back(edit->patch);
            peer.send_text(wire::text_from_message(wire::Change{
                .revision = patches.size(), .patch = edit->patch, .edit_id = edit->id}));
            peer.send_binary(patches.size() == edits
                                 ? tiny_half_frame(patches.size(), ++sequence, 0.5F)
                                 : tiny_jpeg_frame(patches.size(), ++sequence));
        }
    }
}

SequenceOptions options_for(const LoopbackServer& server, const char* script) {
    SequenceOptions options;
    options.connection = {.server = server.url(), .room = "r", .scene = "tiny", .token = ""};
    options.script = sequence_script_from_text(script);
    options.rate_hz = 500;
    return options;
}

TEST(SequencePlayer, SendsEveryEditInOrderAndRecordsEveryImage) {
    std::vector<json> patches;
    LoopbackServer server([&](LoopbackPeer& peer) { play_server(peer, 7, patches); });
    const SequenceReport report = play_sequence(options_for(server, R"({
        "start": {"environment": {"gain": 2}},
        "steps": [
            {"rotate": {"yaw_degrees": [0, 40], "images": 5}},
            {"rest": {"until": 0.01}},
            {"patch": {"display": {"exposure_stops": 1}}},
            {"rest": {"until": "exact"}}]})"));
    static_cast<void>(server.wait_for_request());
    ASSERT_EQ(patches.size(), 7U);
    EXPECT_EQ(patches[0], json({{"environment", {{"gain", 2}}}}));
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(patches[i + 1].at("rotation").at("yaw_degrees"),
                  10.0 * static_cast<double>(i));
    }
    EXPECT_EQ(report.scene, "tiny");
    EXPECT_EQ(report.edits, 6U);  // the start is not counted
    ASSERT_EQ(report.images.size(), 6U);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < report.images.size(); ++i) {
        shown += report.images[i].edit_to_image_ms.size();
        EXPECT_EQ(report.images[i].header.revision, i + 2);
    }
    EXPECT_EQ(shown, 6U);
    EXPECT_TRUE(report.images.back().header.exact);
    EXPECT_EQ(report.images.back().step, 3U);
}

TEST(SequencePlayer, ARestThatNeverBecomesExactFails) {
    std::vector<json> patches;
    LoopbackServer server([&](LoopbackPeer& peer) { play_server(peer, 99, patches); });
    try {
        static_cast<void>(play_sequence(options_for(server, R"({"steps": [
            {"patch": {"display": {"exposure_stops": 1}}},
            {"rest": {"until": "exact", "timeout_seconds": 0.05}}]})")));
        FAIL() << "nothing failed";
    } catch (const ClientError& error) {
        EXPECT_NE(std::string(error.what()).find("step 1: after 0.05 s"), std::string::npos)
            << error.what();
    }
}

TEST(SequencePlayer, ARefusedEditEndsItByTheNumberOfTheStep) {
    LoopbackServer server([&](LoopbackPeer& peer) {
        peer.send_text(tiny_snapshot(0));
        peer.send_binary(tiny_half_frame(0, 1, 0.1F));
        for (std::string text = peer.receive(); !text.empty(); text = peer.receive()) {
            const auto message = wire::parse_client_message(text, wire::Limits{});
            if (const auto* edit = std::get_if<wire::Edit>(&message)) {
                peer.send_text(wire::text_from_message(
                    wire::message_from_error(wire::WireError(wire::ErrorCode::unknown_name,
                                                             "/blend/name", "\"x\"", "one")
                                                 .with_edit_id(edit->id))));
            }
        }
    });
    try {
        static_cast<void>(play_sequence(options_for(
            server,
            R"({"steps": [{"blend": {"name": "x", "amount": [0, 1], "images": 1}}]})")));
        FAIL() << "nothing failed";
    } catch (const ClientError& error) {
        EXPECT_NE(std::string(error.what()).find("unknown_name at /blend/name"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace relume::cli
