// Handshakes and frames that RFC 6455 forbids.
#include "tests/unit/net/hostile_client.h"

#include <random>
#include <string>
#include <vector>

namespace relume::net {
namespace {

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

}  // namespace
}  // namespace relume::net
