#include "client/cli/http_client.h"

#include "client/cli/client_error.h"
#include "tests/unit/cli/loopback_server.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace relume::cli {
namespace {

std::string failure_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const ClientError& error) {
        return error.what();
    }
    return "nothing failed";
}

TEST(HttpClient, GivesStatusAndBody) {
    LoopbackServer server(
        std::string("HTTP/1.1 200 OK\r\nContent-Length: 14\r\n\r\n{\"scenes\": []}"));
    const HttpAnswer answer = http_get(server.url(), "/api/scenes");
    EXPECT_EQ(answer.status, 200U);
    EXPECT_EQ(json_from_answer(answer, "GET"), nlohmann::json::parse(R"({"scenes":[]})"));
    EXPECT_TRUE(server.wait_for_request().starts_with("GET /api/scenes HTTP/1.1\r\n"));
}

TEST(HttpClient, PostsWithALength) {
    LoopbackServer server(std::string("HTTP/1.1 201 Created\r\nContent-Length: 2\r\n\r\n{}"));
    EXPECT_EQ(http_post(server.url(), "/api/environments?name=a", "", "four").status, 201U);
    EXPECT_NE(server.wait_for_request().find("Content-Length: 4\r\n"), std::string::npos);
}

TEST(HttpClient, NamesWhatWentWrong) {
    LoopbackServer nonsense(std::string("BANANA\r\n\r\n"));
    EXPECT_NE(
        failure_of([&] { static_cast<void>(http_get(nonsense.url(), "/x")); }).find("GET http"),
        std::string::npos);
    LoopbackServer silent(std::string{});
    EXPECT_NE(failure_of([&] { static_cast<void>(http_get(silent.url(), "/x")); }).find("/x"),
              std::string::npos);
    LoopbackServer huge(std::string("HTTP/1.1 200 OK\r\nContent-Length: 99999999999\r\n\r\n"));
    EXPECT_NE(
        failure_of([&] { static_cast<void>(http_get(huge.url(), "/x")); }).find("body limit"),
        std::string::npos);
}

TEST(HttpClient, TellsWhatTheServerFoundAndExpected) {
    const HttpAnswer refused{
        .status = 400,
        .body = R"({"error":{"code":"bad_image","message":"m","found":"f","expected":"e"}})"};
    const std::string text =
        failure_of([&] { static_cast<void>(json_from_answer(refused, "POST /x")); });
    EXPECT_NE(text.find("POST /x: found HTTP status 400"), std::string::npos) << text;
    EXPECT_NE(text.find("m (found f, expected e)"), std::string::npos) << text;
    for (const char* body : {"", "<html>", "[]", "{\"error\":1}"}) {
        EXPECT_NE(
            failure_of([&] {
                static_cast<void>(json_from_answer({.status = 502, .body = body}, "GET /"));
            }).find("502"),
            std::string::npos);
    }
    EXPECT_NE(
        failure_of([&] {
            static_cast<void>(json_from_answer({.status = 200, .body = "<html>"}, "GET /"));
        }).find("not JSON"),
        std::string::npos);
}

}  // namespace
}  // namespace relume::cli
