// The table of statuses in protocol/README.md §3, row by row: each fault that it names is
// answered as it says, and the server knows no fault that it does not name.
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace relume::net {
namespace {

namespace fs = std::filesystem;

using StatusAndCode = std::pair<unsigned, std::string>;

std::set<StatusAndCode> rows_of_the_contract() {
    std::set<StatusAndCode> rows;
    std::ifstream file(RELUME_CONTRACT);
    const std::regex row(R"(\| (\d{3}) \| `(\w+)` \| .*)");
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
        if (std::regex_match(line, match, row)) {
            rows.emplace(std::stoul(match[1]), match[2]);
        }
    }
    return rows;
}

class StatusCodes : public RunningServer {
  protected:
    using Fault = std::function<HttpAnswer()>;

    HttpAnswer upload(const std::string& query,
                      const std::string& body,
                      const std::string& fields = {}) {
        return http(port(), "POST", "/api/environments" + query, fields, body);
    }
    HttpAnswer raw(const std::string& request_line, const std::string& fields) {
        return http_raw(port(),
                        request_line + " HTTP/1.1\r\nConnection: close\r\n" + fields + "\r\n");
    }

    // A fault in the words of the table: one that a request has, whoever is asked.
    std::multimap<StatusAndCode, Fault> faults_of_requests() {
        const std::string host = "Host: localhost\r\n";
        return {
            {{400, "missing_field"}, [this] { return upload("", hdr_file()); }},
            {{400, "missing_field"}, [this] { return raw("GET /", ""); }},
            {{400, "missing_field"}, [=, this] { return raw("GET /", host + host); }},
            {{400, "unknown_field"}, [this] { return http(port(), "GET", "/readyz?a=1"); }},
            {{400, "unknown_name"},
             [this] { return upload("?name=m&projection=flat", hdr_file()); }},
            {{400, "out_of_range"}, [this] { return upload("?name=../x", hdr_file()); }},
            {{400, "out_of_range"}, [=, this] { return raw("GET http://h/", host); }},
            {{400, "unsupported"}, [this] { return http(port(), "GET", "/", "", "body"); }},
            {{400, "unsupported"}, [=, this] { return raw("GET / HTTP/9.9", host); }},
            {{400, "unsupported"},
             [this] {
                 std::string request = upgrade_request("/session/r?scene=tiny");
                 request.insert(request.size() - 2, "Sec-WebSocket-Protocol: relume.v9999\r\n");
                 return http_raw(port(), request);
             }},
            {{403, "unsupported"},
             [this] {
                 return upload("?name=m", hdr_file(), "Origin: http://evil.example\r\n");
             }},
            {{404, "not_found"}, [this] { return http(port(), "GET", "/api/none"); }},
            {{404, "not_found"},
             [this] { return http(port(), "GET", "/api/scenes/none/thumbnail.png"); }},
            {{404, "not_found"},
             [this] { return http_raw(port(), upgrade_request("/session/.r?scene=tiny")); }},
            {{405, "unsupported"}, [this] { return http(port(), "DELETE", "/readyz"); }},
            {{409, "unsupported"}, [this] { return upload("?name=sky-noon", hdr_file()); }},
            {{411, "missing_field"},
             [this] { return http(port(), "POST", "/api/environments?name=m"); }},
            {{413, "too_large"}, [this] { return upload("?name=m", std::string(9000, 'x')); }},
            {{421, "unsupported"},
             [this] { return raw("GET /readyz", "Host: evil.example\r\n"); }},
            {{422, "bad_image"}, [this] { return upload("?name=m", "no image"); }},
            {{426, "unsupported"},
             [this] { return http(port(), "GET", "/session/r?scene=tiny"); }},
            {{431, "too_large"},
             [=, this] {
                 return raw("GET /", host + "X: " + std::string(20'000, 'x') + "\r\n");
             }},
            {{500, "bad_image"},
             [this] { return http(port(), "GET", "/api/environments/broken/preview.jpg"); }},
            {{501, "unsupported"},
             [=, this] {
                 return raw("POST /api/environments?name=m",
                            host + "Transfer-Encoding: chunked\r\n");
             }},
        };
    }
    // A fault that the server's state or configuration makes one; leaves a server behind.
    std::multimap<StatusAndCode, Fault> faults_of_servers() {
        return {
            {{401, "unsupported"},
             [this] {
                 configuration_.token = "secret";
                 start();
                 return upload("?name=m&token=other", hdr_file());
             }},
            {{503, "shutting_down"},
             [this] {
                 // So many that the answer comes before they are open.
                 const fs::path many = environments_.path() / "many";
                 fs::create_directory(many);
                 for (int i = 0; i < 1000; ++i) {
                     fs::create_directory_symlink(scenes_.path() / "tiny.relume",
                                                  many / (std::to_string(i) + ".relume"));
                 }
                 configuration_.scenes = many;
                 server_ = std::make_unique<Server>(configuration_);
                 return http_raw(port(), upgrade_request("/session/r?scene=0"));
             }},
            {{503, "too_many"},
             [this] {
                 configuration_.connection.concurrent_uploads = 1;
                 start();
                 RawSocket slow(port());
                 slow.send(
                     "POST /api/environments?name=m HTTP/1.1\r\nHost: localhost\r\n"
                     "Content-Length: 100\r\nExpect: 100-continue\r\n\r\n");
                 static_cast<void>(slow.receive_until("\r\n\r\n"));  // it has its place
                 const HttpAnswer answer = upload("?name=n", hdr_file());
                 EXPECT_NE(answer.head.find("\r\nRetry-After: "), std::string::npos);
                 return answer;
             }},
            {{507, "too_many"},
             [this] {
                 configuration_.environment_bounds.uploads = 1;
                 start();
                 EXPECT_EQ(upload("?name=m", hdr_file(8, 4)).status, 201U);
                 // One that lights a room makes no place for another.
                 WebSocketClient client(port(), "/session/r?scene=tiny");
                 client.send(nlohmann::json{{"type", "edit"},
                                            {"id", 1},
                                            {"patch", {{"environment", {{"name", "m"}}}}}});
                 static_cast<void>(client.receive_message("change"));
                 return upload("?name=n", hdr_file(8, 4));
             }},
        };
    }

    static void expect_answer(const StatusAndCode& expected, const HttpAnswer& answer) {
        EXPECT_EQ(answer.status, expected.first) << answer.head << answer.body;
        const auto body = nlohmann::json::parse(answer.body, nullptr, false);
        ASSERT_TRUE(body.is_object() && body.contains("error"))
            << expected.first << ": " << answer.head << answer.body;
        EXPECT_EQ(body["error"]["code"], expected.second) << answer.body;
        for (const char* const key : {"message", "found", "expected"}) {
            EXPECT_TRUE(body["error"].contains(key)) << key << ": " << answer.body;
        }
    }
};

TEST_F(StatusCodes, EveryFaultIsAnsweredAsTheContractSays) {
    std::set<StatusAndCode> tried;
    configuration_.limits.upload_bytes = 8192;
    // Of a size that is known, and without its second half.
    const std::string whole = hdr_file();
    std::ofstream(environments_.path() / "broken.hdr", std::ios::binary)
        << whole.substr(0, whole.size() / 2);
    const Configuration plain = configuration_;
    start();
    for (const auto& [expected, fault] : faults_of_requests()) {
        tried.insert(expected);
        expect_answer(expected, fault());
    }
    expect_serves_on();
    for (const auto& [expected, fault] : faults_of_servers()) {
        tried.insert(expected);
        server_.reset();
        configuration_ = plain;
        expect_answer(expected, fault());
    }
    EXPECT_EQ(tried, rows_of_the_contract());
}

}  // namespace
}  // namespace relume::net
