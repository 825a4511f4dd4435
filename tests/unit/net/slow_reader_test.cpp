// Clients that do not read what they are sent, or leave in the middle of it.
#include "tests/unit/net/hostile_client.h"

#include <chrono>
#include <string>
#include <thread>

namespace relume::net {
namespace {

using nlohmann::json;

TEST_F(HostileClient, LeavingMidImageHurtsNobody) {
    start();
    WebSocketClient stays(port(), kTarget);
    for (int round = 0; round < 20; ++round) {
        WebSocketClient leaves(port(), kTarget);
        static_cast<void>(leaves.receive_message("snapshot"));
        leaves.send(json{{"type", "edit"},
                         {"id", round},
                         {"patch", {{"environment", {{"gain", round + 1}}}}}});
        leaves.vanish();
    }
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_clients 1"); }));
    expect_serves_on();
    stays.send(json{{"type", "edit"}, {"id", 99}, {"patch", {{"environment", {{"gain", 7}}}}}});
    while (stays.receive_message("change").value("edit_id", 0) != 99) {
    }
}

TEST_F(HostileClient, WhoNeverReadsIsCutOffAndHoldsNobodyUp) {
    configuration_.connection.send_buffer_bytes = 4096;
    configuration_.connection.write_timeout = std::chrono::milliseconds(100);
    configuration_.connection.write_grace = std::chrono::milliseconds(100);
    configuration_.limits.messages_per_second = 1'000'000;
    configuration_.limits.message_burst = 1'000'000;
    start();
    const auto never_reads = upgraded(4096);
    WebSocketClient author(port(), std::string(kTarget) + "&images=settled");
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_clients 2"); }));
    // Changes of some kilobytes each, until the other's buffers are full.
    std::uint64_t id = 0;
    EXPECT_TRUE(eventually([&] {
        json lights = json::object();
        for (int i = 0; i < 60; ++i) {
            lights["light-" + std::to_string(i)] = {
                {"direction", {0.1 * i, 1, 0.3}},
                {"angular_radius_degrees", 5},
                {"radiance", {1.0 + static_cast<double>(id), 1, 1}}};
        }
        author.send(json{{"type", "edit"}, {"id", ++id}, {"patch", {{"lights", lights}}}});
        // The author is answered all the while; several changes may come as one.
        while (author.receive_message("change").value("edit_id", std::uint64_t{0}) != id) {
        }
        return metrics_say("relume_clients 1");
    }));
    EXPECT_TRUE(metrics_say(R"(relume_closes_total{code="4006"} 1)"));
    expect_serves_on();
}

TEST_F(HostileClient, WhoReadsAgainInTimeIsToldWhyItMustGo) {
    configuration_.connection.send_buffer_bytes = 4096;
    configuration_.connection.write_timeout = std::chrono::milliseconds(50);
    configuration_.connection.write_grace = std::chrono::minutes(1);
    // One message larger than all buffers: the snapshot of a room full of lights.
    configuration_.limits.lights_per_room = 4000;
    configuration_.limits.message_bytes = std::uint64_t{4} << 20;
    start();
    WebSocketClient author(port(), std::string(kTarget) + "&images=settled");
    json lights = json::object();
    for (int i = 0; i < 4000; ++i) {
        lights["a-light-with-a-rather-long-name-" + std::to_string(i)] = {
            {"direction", {0.1 * i, 1, 0.3}},
            {"angular_radius_degrees", 5},
            {"radiance", {1, 1, 1}}};
    }
    author.send(json{{"type", "edit"}, {"id", 1}, {"patch", {{"lights", lights}}}});
    static_cast<void>(author.receive_message("change"));
    const auto sleeps = upgraded(4096);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // well beyond its 50
    // Its close frame: 0x88, length, code 4006.
    EXPECT_NE(sleeps->receive_until("\x0F\xA6").find("\x0F\xA6"), std::string::npos);
}

}  // namespace
}  // namespace relume::net
