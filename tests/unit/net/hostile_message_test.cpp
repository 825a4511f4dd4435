// Messages that no client should send.
#include "tests/unit/net/hostile_client.h"

#include <string>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

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

}  // namespace
}  // namespace relume::net
