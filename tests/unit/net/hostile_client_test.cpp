// Clients that do what none should. Each gets a named end, and the server serves on.
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

constexpr const char* kTarget = "/session/r?scene=tiny";

class HostileClient : public RunningServer {
  protected:
    // The error that a text is answered with; the session goes on after it.
    json error_for(const std::string& text) {
        WebSocketClient client(port(), kTarget);
        client.send(text);
        json error = client.receive_message("error");
        client.send(json{{"type", "edit"}, {"id", 9}, {"patch", json::object()}});
        EXPECT_EQ(client.receive_message("change")["edit_id"], 9);
        return error;
    }
    // A socket that has just become a WebSocket in the room.
    std::unique_ptr<RawSocket> upgraded(int receive_buffer_bytes = 0) {
        auto socket = std::make_unique<RawSocket>(port(), receive_buffer_bytes);
        socket->send(upgrade_request(kTarget));
        EXPECT_TRUE(socket->receive_until("\r\n\r\n").starts_with("HTTP/1.1 101 "));
        return socket;
    }
};

struct BadEdit {
    const char* text;
    const char* code;
    const char* path;
};

TEST_F(HostileClient, BadEditsGetNamedErrors) {
    start();
    const std::vector<BadEdit> cases{
        {R"({"type":"edit","id":1,"patch":{"environment":{"gain":-1}}})", "out_of_range",
         "/environment/gain"},
        {R"({"type":"edit","id":1,"patch":{"environment":{"gain":"high"}}})", "wrong_type",
         "/environment/gain"},
        {R"({"type":"edit","id":1,"patch":{"no_such_field":1}})", "unknown_field",
         "/no_such_field"},
        {R"({"type":"edit","id":1,"patch":{"environment":{"name":"none"}}})", "unknown_name",
         "/environment/name"},
        {R"({"type":"edit","id":1,"patch":{"blend":{"name":"none"}}})", "unknown_name",
         "/blend/name"},
        {R"({"type":"edit","id":1,"patch":{"lights":{"key":{"gain":1}}}})", "missing_field",
         nullptr},
    };
    for (const BadEdit& bad : cases) {
        const json error = error_for(bad.text);
        EXPECT_EQ(error["code"], bad.code) << bad.text;
        EXPECT_EQ(error["edit_id"], 1) << bad.text;
        if (bad.path != nullptr) {
            EXPECT_EQ(error["path"], bad.path);
        }
        EXPECT_FALSE(error["expected"].get<std::string>().empty()) << bad.text;
    }
    expect_serves_on();
}

TEST_F(HostileClient, TextsThatAreNoMessagesGetNamedErrors) {
    start();
    EXPECT_EQ(error_for("{")["code"], "malformed_json");
    EXPECT_EQ(error_for("")["code"], "malformed_json");
    EXPECT_EQ(error_for(R"({"type":"edit","type":"ack"})")["code"], "malformed_json");
    EXPECT_EQ(error_for(std::string(5000, '['))["code"], "malformed_json");
    EXPECT_EQ(error_for("[]")["code"], "wrong_type");
    EXPECT_EQ(error_for(R"({"type":"shutdown"})")["code"], "unknown_type");
    EXPECT_EQ(error_for(R"({"type":"ack"})")["code"], "missing_field");
    EXPECT_EQ(error_for(R"({"type":"ack","sequence":-1})")["code"], "out_of_range");
    expect_serves_on();
}

TEST_F(HostileClient, TooManyLightsAreRefused) {
    configuration_.limits.lights_per_room = 2;
    start();
    json lights = json::object();
    for (const char* const id : {"a", "b", "c"}) {
        lights[id] = {
            {"direction", {0, 1, 0}}, {"angular_radius_degrees", 5}, {"radiance", {1, 1, 1}}};
    }
    const json error =
        error_for(json{{"type", "edit"}, {"id", 1}, {"patch", {{"lights", lights}}}}.dump());
    EXPECT_EQ(error["code"], "too_many");
    expect_serves_on();
}

TEST_F(HostileClient, OversizedMessagesClose) {
    start();
    WebSocketClient client(port(), kTarget);
    client.send(std::string(configuration_.limits.message_bytes + 1, ' '));
    EXPECT_EQ(client.receive_close(), 1009U);
    expect_serves_on();
}

TEST_F(HostileClient, BinaryFramesClose) {
    start();
    WebSocketClient client(port(), kTarget);
    client.send_binary("\x01\x02\x03");
    EXPECT_EQ(client.receive_close(), 1003U);
    expect_serves_on();
}

TEST_F(HostileClient, TooManyErrorsClose) {
    configuration_.limits.errors_per_connection = 5;
    start();
    WebSocketClient client(port(), kTarget);
    for (int i = 0; i < 5; ++i) {
        client.send(std::string("{"));
    }
    EXPECT_EQ(client.receive_close(), 4005U);
    EXPECT_TRUE(metrics_say(R"(relume_closes_total{code="4005"} 1)"));
    EXPECT_TRUE(metrics_say(R"(relume_errors_total{code="malformed_json"} 5)"));
    expect_serves_on();
}

// However few of them the client has read: the last is told, too.
TEST_F(HostileClient, TheStatedNumberOfErrorsIsTakenInABurst) {
    start();
    const std::uint64_t cap = configuration_.limits.errors_per_connection;
    WebSocketClient client(port(), kTarget);
    for (std::uint64_t i = 1; i < cap; ++i) {
        client.send(std::string("{"));
    }
    for (std::uint64_t i = 1; i < cap; ++i) {
        EXPECT_EQ(client.receive_message("error")["code"], "malformed_json");
    }
    client.send(std::string("{"));
    EXPECT_EQ(client.receive_message("error")["code"], "malformed_json");
    EXPECT_EQ(client.receive_close(), 4005U);
}

TEST_F(HostileClient, TooManyMessagesClose) {
    configuration_.limits.messages_per_second = 1;
    configuration_.limits.message_burst = 10;
    start();
    WebSocketClient client(port(), kTarget);
    for (std::uint64_t i = 0; i < 12; ++i) {
        client.acknowledge(i);
    }
    EXPECT_EQ(client.receive_close(), 4002U);
    configuration_.limits.message_burst = 512;
    expect_serves_on();
}

TEST_F(HostileClient, LongMessagesCountForMore) {
    configuration_.limits.messages_per_second = 1;
    configuration_.limits.message_burst = 20;
    start();
    WebSocketClient client(port(), kTarget);
    const std::string padded =
        R"({"type":"edit","id":1,"patch":{}})" + std::string(40'000, ' ');  // ten of 4 KiB
    client.send(padded);
    client.send(padded);
    static_cast<void>(client.receive_message("change"));
    client.send(padded);
    EXPECT_EQ(client.receive_close(), 4002U);
}

TEST_F(HostileClient, PingsCountAsMessages) {
    configuration_.limits.messages_per_second = 1;
    configuration_.limits.message_burst = 10;
    start();
    const auto socket = upgraded();
    std::string pings;
    for (int i = 0; i < 20; ++i) {
        pings += std::string("\x89\x80\0\0\0\0", 6);
    }
    socket->send(pings);
    // Its close frame: 0x88, length, code 4002.
    EXPECT_NE(socket->receive_until("\x0F\xA2").find("\x0F\xA2"), std::string::npos);
}

// Boost 1.81 does not look at the top bit of a 64-bit frame length.
TEST_F(HostileClient, FrameLengthsBeyondReasonHoldNothing) {
    start();
    for (const char* const length :
         {"\x80\0\0\0\0\0\0\0", "\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", "\x80\0\0\0\0\0\0\x10",
          "\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFF", "\0\0\0\x01\0\0\0\0"}) {
        const auto socket = upgraded();
        socket->send(std::string("\x81\xFF", 2) + std::string(length, 8) +
                     std::string(4, '\0') + std::string(64, 'x'));
        static_cast<void>(socket->receive_all());  // the server ends it
    }
    expect_serves_on();
}

TEST_F(HostileClient, FramesAgainstTheProtocolEndTheConnection) {
    start();
    const std::vector<std::string> frames{
        std::string("\x81\x05hello", 7),             // not masked
        std::string("\x83\x80\0\0\0\0", 6),          // reserved opcode
        std::string("\xC1\x80\0\0\0\0", 6),          // a compressed frame nobody agreed on
        std::string("\x80\x80\0\0\0\0", 6),          // continues nothing
        std::string("\x89\xFE\x01\0\0\0\0\0", 8),    // a ping longer than 125
        std::string("\x09\x80\0\0\0\0", 6),          // a ping in parts
        std::string("\x81\x82\0\0\0\0\xFF\xFE", 8),  // no UTF-8
        std::string("\x88\x81\0\0\0\0x", 7),         // half a close code
        std::string("\x81\xFE\0\x01\0\0\0\0x", 9),   // a short length in 16 bits
    };
    for (const std::string& frame : frames) {
        const auto socket = upgraded();
        socket->send(frame);
        static_cast<void>(socket->receive_all());
    }
    expect_serves_on();
}

// [RFC 6455 §7.4]: a code that may not be sent is a protocol error; one that may comes back.
TEST_F(HostileClient, CloseCodesAreAnsweredAsTheProtocolSays) {
    start();
    const auto answer_to = [this](unsigned code) {
        const auto socket = upgraded();
        socket->send(std::string("\x88\x82\0\0\0\0", 6) + static_cast<char>(code >> 8) +
                     static_cast<char>(code & 0xFF));
        const std::string bytes = socket->receive_all();
        const std::size_t frame = bytes.rfind('\x88');
        return frame == std::string::npos || frame + 4 > bytes.size()
                   ? 0U
                   : static_cast<unsigned char>(bytes[frame + 2]) * 256U +
                         static_cast<unsigned char>(bytes[frame + 3]);
    };
    for (const unsigned code :
         {0U, 999U, 1004U, 1005U, 1006U, 1015U, 1016U, 2999U, 5000U, 9999U, 65535U}) {
        EXPECT_EQ(answer_to(code), 1002U) << code;
    }
    for (const unsigned code : {1000U, 1001U, 1011U, 3000U, 4000U, 4999U}) {
        EXPECT_EQ(answer_to(code), code);
    }
    expect_serves_on();
}

TEST_F(HostileClient, HandshakesAgainstTheProtocolAreRefused) {
    start();
    const auto status_of = [this](const std::string& fields) {
        return http_raw(port(), std::string("GET ") + kTarget +
                                    " HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
                                    "Upgrade: websocket\r\n" +
                                    fields + "\r\n")
            .status;
    };
    const std::string version = "Sec-WebSocket-Version: 13\r\n";
    const std::string key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    EXPECT_EQ(status_of(version), 400U);
    EXPECT_EQ(status_of(version + key + key), 400U);
    for (const char* const value :
         {"", "AA==", "dGhlIHNhbXBsZSBub25jZQ", "dGhlIHNhbXBsZSBub25jZQ=x",
          "dGhlIHNhbXBsZSBub25jZSE=", "dGhlIHNhbXBsZSBub25*ZQ==",
          "dGhlIHNhbXBsZSBub25jZWRGhlIHNhbXBsZSBub25jZQ=="}) {
        EXPECT_EQ(status_of(version + "Sec-WebSocket-Key: " + value + "\r\n"), 400U) << value;
    }
    EXPECT_EQ(status_of(key), 426U);
    EXPECT_EQ(status_of(key + version + version), 426U);
    EXPECT_EQ(status_of(key + "Sec-WebSocket-Version: 12\r\n"), 426U);
    expect_serves_on();
}

TEST_F(HostileClient, GarbageAfterTheUpgradeEndsTheConnection) {
    start();
    std::mt19937 generator(3);
    for (int round = 0; round < 20; ++round) {
        std::string garbage;
        for (int i = 0; i < 4096; ++i) {
            garbage.push_back(static_cast<char>(generator()));
        }
        const auto socket = upgraded();
        socket->send(garbage);
        socket->end_sending();
        static_cast<void>(socket->receive_all());
    }
    expect_serves_on();
}

TEST_F(HostileClient, AConnectionMayEndAfterAnyByte) {
    start();
    const std::string upgrade = upgrade_request(kTarget);
    const std::string whole =
        upgrade + masked_text_frame(R"({"type":"ack","sequence":1})") +
        masked_text_frame(R"({"type":"edit","id":1,"patch":{"environment":{"gain":2}}})");
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        RawSocket socket(port());
        socket.send(std::string_view(whole).substr(0, std::min(length, upgrade.size())));
        if (length > upgrade.size()) {
            static_cast<void>(socket.receive_until("\r\n\r\n"));
            socket.send(
                std::string_view(whole).substr(upgrade.size(), length - upgrade.size()));
        }
    }
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_connections 0"); }));
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_clients 0"); }));
    expect_serves_on();
}

TEST_F(HostileClient, FramesBeforeTheAnswerAreRefused) {
    start();
    RawSocket socket(port());
    socket.send(upgrade_request(kTarget) + masked_text_frame("{}"));
    const std::string answer = socket.receive_all();
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 ")) << answer;
}

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
    held.resize(3);
    unsigned uploads = 0;
    for (int i = 0; i < 3; ++i) {
        held.push_back(std::make_unique<RawSocket>(port(), 0, greedy));
        held.back()->send(
            "POST /api/environments?name=held HTTP/1.1\r\nHost: localhost\r\n"
            "Expect: 100-continue\r\nContent-Length: 1000\r\n\r\n");
        uploads += held.back()->receive_until("\r\n\r\n").starts_with("HTTP/1.1 100") ? 1U : 0U;
    }
    EXPECT_EQ(uploads, 2U);
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
