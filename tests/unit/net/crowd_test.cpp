// What the clients of one address may take of what all share.
#include "tests/unit/net/hostile_client.h"

#include <chrono>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace relume::net {
namespace {

// What one address takes, the others still get.
TEST_F(HostileClient, OneAddressDoesNotLockTheOthersOut) {
    configuration_.connection.connections = 40;
    configuration_.connection.connections_per_address = 10;
    configuration_.limits.rooms = 6;
    configuration_.rooms.rooms_per_address = 3;
    configuration_.connection.concurrent_uploads = 4;
    configuration_.connection.uploads_per_address = 2;
    configuration_.connection.handshake_timeout = std::chrono::milliseconds(200);
    start();
    const char* const greedy = "127.0.0.2";
    std::vector<std::unique_ptr<RawSocket>> held;
    unsigned rooms = 0;
    for (int i = 0; i < 5; ++i) {
        held.push_back(std::make_unique<RawSocket>(port(), 0, greedy));
        held.back()->send(
            upgrade_request("/session/held-" + std::to_string(i) + "?scene=tiny"));
        const std::string answer = held.back()->receive_until("\"viewers\"");
        rooms += answer.find("snapshot") != std::string::npos ? 1U : 0U;
    }
    EXPECT_EQ(rooms, 3U);
    // Who was refused leaves, so that it is known how many places are taken.
    held.resize(3);
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_connections 3"); }));
    unsigned uploads = 0;
    for (int i = 0; i < 3; ++i) {
        held.push_back(std::make_unique<RawSocket>(port(), 0, greedy));
        held.back()->send(
            "POST /api/environments?name=held HTTP/1.1\r\nHost: localhost\r\n"
            "Expect: 100-continue\r\nContent-Length: 1000\r\n\r\n");
        uploads += held.back()->receive_until("\r\n\r\n").starts_with("HTTP/1.1 100") ? 1U : 0U;
    }
    EXPECT_EQ(uploads, 2U);
    held.pop_back();
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_connections 5"); }));
    for (int i = 0; i < 60; ++i) {
        held.push_back(std::make_unique<RawSocket>(port(), 0, greedy));
    }
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_connections 10"); }));
    expect_serves_on();
    write_hdr(scenes_.path() / "other.hdr", 16, 8, 1);
    std::ifstream file(scenes_.path() / "other.hdr", std::ios::binary);
    const std::string body{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(http(port(), "POST", "/api/environments?name=other", {}, body).status, 201U);
}

// A room that its maker's address left gives way to that address's next one.
TEST_F(HostileClient, RoomsBehindAProxyCountForWhomItNames) {
    configuration_.trusted_proxies = {"127.0.0.1"};
    configuration_.rooms.rooms_per_address = 1;
    configuration_.rooms.linger = std::chrono::hours(1);
    start();
    const auto enter = [this](const std::string& room, const std::string& forwarded_for) {
        return std::make_unique<WebSocketClient>(
            port(), "/session/" + room + "?scene=tiny",
            WebSocketClient::Fields{{"X-Forwarded-For", forwarded_for}});
    };
    auto first = enter("a", "10.0.0.1");
    static_cast<void>(first->receive_message("snapshot"));
    EXPECT_EQ(enter("b", "10.0.0.2, 10.0.0.1")->receive_close(), 4007U);
    EXPECT_EQ(enter("c", "10.0.0.1, 10.0.0.2")->receive_message("snapshot")["room"], "c");
    first->vanish();
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_clients 0"); }));
    EXPECT_EQ(enter("b", "10.0.0.1")->receive_message("snapshot")["room"], "b");
}

TEST_F(HostileClient, OneAddressDoesNotFillARoom) {
    configuration_.trusted_proxies = {"127.0.0.1"};
    configuration_.limits.clients_per_room = 3;
    configuration_.rooms.room.clients_per_address = 2;
    start();
    const auto enter = [this](const std::string& address) {
        return std::make_unique<WebSocketClient>(
            port(), kTarget, WebSocketClient::Fields{{"X-Forwarded-For", address}});
    };
    const auto first = enter("10.0.0.1");
    static_cast<void>(first->receive_message("snapshot"));
    const auto second = enter("10.0.0.1");
    static_cast<void>(second->receive_message("snapshot"));
    EXPECT_EQ(enter("10.0.0.1")->receive_close(), 4003U);
    EXPECT_EQ(enter("10.0.0.2")->receive_message("snapshot")["viewers"], 3);
}

}  // namespace
}  // namespace relume::net
