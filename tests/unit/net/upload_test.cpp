// Maps that clients send.
#include "tests/unit/net/hdr_file.h"
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <string>
#include <thread>

namespace relume::net {
namespace {

using nlohmann::json;

class UploadTest : public RunningServer {
  protected:
    HttpAnswer upload(const std::string& query, const std::string& body) {
        return http(port(), "POST", "/api/environments" + query, {}, body);
    }
};

TEST_F(UploadTest, UploadsAreDecodedAndListed) {
    start();
    const HttpAnswer answer = upload("?name=mine", hdr_file());
    ASSERT_EQ(answer.status, 201U) << answer.body;
    const json made = json::parse(answer.body);
    EXPECT_EQ(made["name"], "mine");
    EXPECT_EQ(made["width"], 32);
    EXPECT_EQ(made["projection"], "lat_long");
    bool listed = false;
    const json listing = json::parse(http(port(), "GET", "/api/environments").body);
    for (const json& environment : listing["environments"]) {
        listed = listed || (environment["name"] == "mine" && environment["kind"] == "upload");
    }
    EXPECT_TRUE(listed);
    EXPECT_EQ(http(port(), "GET", "/api/environments/mine/preview.jpg").status, 200U);
}

// While a map is decoded its connection is watched for the client's end; whatever the system
// says of the connection meanwhile, the threads that serve sockets go on.
TEST_F(UploadTest, EveryOneOfManyUploadsIsAnswered) {
    start();
    const std::string file = hdr_file(8, 4);
    for (int i = 0; i < 600; ++i) {
        RawSocket socket(port());
        socket.send("POST /api/environments?name=u" + std::to_string(i % 4) +
                    " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) +
                    "\r\nContent-Length: " + std::to_string(file.size()) + "\r\n\r\n");
        socket.send(file);
        ASSERT_EQ(socket.receive_until("\r\n\r\n").substr(0, 12), "HTTP/1.1 201") << i;
    }
}

TEST_F(UploadTest, WhatComesDuringADecodeIsTheNextRequest) {
    start();
    const std::string file = hdr_file(8, 4);
    const std::string host = " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) + "\r\n";
    const std::string next = "GET /healthz" + host + "Connection: close\r\n\r\n";
    for (std::size_t sent_early = 0; sent_early <= next.size(); sent_early += 9) {
        RawSocket socket(port());
        socket.send("POST /api/environments?name=u" + host +
                    "Content-Length: " + std::to_string(file.size()) + "\r\n\r\n" + file);
        // While the file is being decoded, as far as one can tell from outside.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        socket.send(next.substr(0, sent_early));
        std::string answers = socket.receive_until("\r\n\r\n");
        socket.send(next.substr(sent_early));
        answers += socket.receive_all();
        ASSERT_TRUE(answers.starts_with("HTTP/1.1 201 ")) << answers;
        ASSERT_NE(answers.find("HTTP/1.1 200 "), std::string::npos) << sent_early << answers;
    }
}

TEST_F(UploadTest, BadUploadsGetNamedErrors) {
    configuration_.limits.upload_bytes = 100'000;
    start();
    const auto code = [](const HttpAnswer& answer) {
        return std::to_string(answer.status) + " " +
               json::parse(answer.body)["error"]["code"].get<std::string>();
    };
    const std::string file = hdr_file();
    EXPECT_EQ(code(upload("?name=mine", "this is no image")), "422 bad_image");
    EXPECT_EQ(code(upload("?name=mine", file.substr(0, 100))), "422 bad_image");
    EXPECT_EQ(code(upload("?name=mine", hdr_file(33, 16))), "422 bad_image");
    EXPECT_EQ(code(upload("", file)), "400 missing_field");
    EXPECT_EQ(code(upload("?name=../x", file)), "400 out_of_range");
    EXPECT_EQ(code(upload("?name=mine&projection=flat", file)), "400 unknown_name");
    EXPECT_EQ(code(upload("?name=sky-noon", file)), "409 unsupported");
    EXPECT_EQ(code(http(port(), "POST", "/api/environments?name=mine")), "411 missing_field");
    EXPECT_EQ(code(upload("?name=mine", std::string(100'001, 'x'))), "413 too_large");
    EXPECT_EQ(code(http(port(), "POST", "/api/environments?name=mine",
                        "Origin: http://evil.example\r\n", file)),
              "403 unsupported");
    expect_serves_on();
}

TEST_F(UploadTest, UploadsAskForTheToken) {
    configuration_.token = "secret";
    start();
    const std::string file = hdr_file();
    EXPECT_EQ(upload("?name=mine", file).status, 401U);
    EXPECT_EQ(upload("?name=mine&token=secret", file).status, 201U);
    EXPECT_EQ(http(port(), "POST", "/api/environments?name=mine",
                   "Authorization: Bearer secret\r\n", file)
                  .status,
              201U);
}

TEST_F(UploadTest, ClientsThatAskWhetherToGoOnAreAnswered) {
    start();
    const std::string file = hdr_file();
    RawSocket socket(port());
    socket.send(
        "POST /api/environments?name=mine HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n"
        "Expect: 100-continue\r\nContent-Length: " +
        std::to_string(file.size()) + "\r\n\r\n");
    EXPECT_TRUE(socket.receive_until("\r\n\r\n").starts_with("HTTP/1.1 100 "));
    socket.send(file);
    EXPECT_TRUE(socket.receive_all().starts_with("HTTP/1.1 201 "));
}

// Bytes that come in time earn more of it, up to the whole; a trickle earns none.
TEST_F(UploadTest, UploadsThatTrickleAreCutOff) {
    configuration_.connection.body_grace = std::chrono::milliseconds(100);
    configuration_.connection.body_bytes_per_second = 1000;
    start();
    RawSocket trickle(port());
    trickle.send(
        "POST /api/environments?name=m HTTP/1.1\r\nHost: localhost\r\n"
        "Content-Length: 1000000\r\n\r\n");
    EXPECT_TRUE(eventually([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return !trickle.send("x") || trickle.has_ended();
    }));
    expect_serves_on();
}

}  // namespace
}  // namespace relume::net
