// What each path answers, and what Beast 1.81 must be kept from.
#include "tests/unit/net/hdr_file.h"
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class HttpTest : public RunningServer {
  protected:
    std::string hdr_file(int width = 32, int height = 16) {
        const fs::path path = scenes_.path() / "upload.hdr";
        write_hdr(path, width, height, 0.5F);
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    HttpAnswer upload(const std::string& query, const std::string& body) {
        return http(port(), "POST", "/api/environments" + query, {}, body);
    }
};

TEST_F(HttpTest, HealthReadinessMetrics) {
    start();
    EXPECT_EQ(http(port(), "GET", "/healthz").status, 200U);
    EXPECT_EQ(http(port(), "GET", "/readyz").status, 200U);
    const HttpAnswer metrics = http(port(), "GET", "/metrics");
    EXPECT_EQ(metrics.status, 200U);
    EXPECT_NE(metrics.body.find("# TYPE relume_rooms gauge"), std::string::npos);
    EXPECT_NE(metrics.body.find("relume_relight_seconds_bucket"), std::string::npos);
}

TEST_F(HttpTest, ListsScenesAndServesOnBesideABrokenOne) {
    fs::copy(scenes_.path() / "tiny.relume", scenes_.path() / "broken.relume",
             fs::copy_options::recursive);
    fs::resize_file(scenes_.path() / "broken.relume/shards/00000.shard", 100);
    start();
    const json scenes = json::parse(http(port(), "GET", "/api/scenes").body)["scenes"];
    ASSERT_EQ(scenes.size(), 1U);
    EXPECT_EQ(scenes[0]["name"], "tiny");
    EXPECT_EQ(scenes[0]["width"], 40);
    EXPECT_EQ(scenes[0]["height"], 24);
    EXPECT_EQ(scenes[0]["face_resolution"], 8);
    EXPECT_EQ(scenes[0]["kind"], "image");
    EXPECT_EQ(scenes[0]["basis"], "haar");
    EXPECT_EQ(scenes[0]["columns"], 6 * 8 * 8);
    EXPECT_GT(scenes[0]["memory_bytes"], scenes[0]["bytes"]);
    EXPECT_FALSE(scenes[0]["edits"].empty());
    EXPECT_GT(scenes[0]["bytes"], 1000);
    expect_serves_on();
}

// In place, as no careful program would: the copy that is served does not change.
TEST_F(HttpTest, AServedSceneThatIsChangedInPlaceHurtsNobody) {
    start();
    const fs::path scene = scenes_.path() / "tiny.relume";
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(scene)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    for (const fs::path& path : files) {
        const std::string zeroes(fs::file_size(path), '\xFF');
        std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << zeroes;
    }
    expect_serves_on();
    for (const fs::path& path : files) {
        fs::resize_file(path, 0);
    }
    expect_serves_on();
}

TEST_F(HttpTest, ScenesThatComeChangeAndGoAreFollowed) {
    configuration_.scenes_interval = std::chrono::milliseconds(20);
    start();
    const auto widths = [this] {
        std::map<std::string, int> found;
        const json listing = json::parse(http(port(), "GET", "/api/scenes").body);
        for (const json& scene : listing["scenes"]) {
            found[scene["name"]] = scene["width"];
        }
        return found;
    };
    using Widths = std::map<std::string, int>;
    const fs::path other = scenes_.path() / "elsewhere";
    test::write_tiny_transport(other, {.width = 16});
    fs::rename(other, scenes_.path() / "other.relume");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"other", 16}, {"tiny", 40}}; }));

    // Somebody is in a room of it while it is replaced, and stays there.
    WebSocketClient inside(port(), "/session/old?scene=other");
    static_cast<void>(inside.receive_settled(0));
    test::write_tiny_transport(other, {.width = 24});
    fs::rename(scenes_.path() / "other.relume", scenes_.path() / "away");
    fs::rename(other, scenes_.path() / "other.relume");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"other", 24}, {"tiny", 40}}; }));
    inside.send(json{{"type", "edit"}, {"id", 1}, {"patch", {{"environment", {{"gain", 2}}}}}});
    EXPECT_EQ(inside.receive_settled(1).image_header().width, 16U);
    WebSocketClient outside(port(), "/session/new?scene=other");
    EXPECT_EQ(outside.receive_settled(0).image_header().width, 24U);
    inside.vanish();
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_rooms 1"); }));

    fs::remove_all(scenes_.path() / "other.relume");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"tiny", 40}}; }));
    EXPECT_EQ(WebSocketClient(port(), "/session/newer?scene=other").receive_close(), 4004U);
    outside.send(
        json{{"type", "edit"}, {"id", 1}, {"patch", {{"environment", {{"gain", 2}}}}}});
    EXPECT_EQ(outside.receive_settled(1).image_header().width, 24U);

    // A broken one is left out until it is whole.
    fs::copy(scenes_.path() / "tiny.relume", other, fs::copy_options::recursive);
    fs::rename(other / "columns.bin", scenes_.path() / "columns.bin");
    fs::rename(other, scenes_.path() / "late.relume");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(widths(), (Widths{{"tiny", 40}}));
    fs::rename(scenes_.path() / "columns.bin", scenes_.path() / "late.relume/columns.bin");
    EXPECT_TRUE(eventually([&] { return widths() == Widths{{"late", 40}, {"tiny", 40}}; }));
    expect_serves_on();
}

TEST_F(HttpTest, ThumbnailsAreServedIfTheBakeLeftThem) {
    start();
    EXPECT_EQ(http(port(), "GET", "/api/scenes/tiny/thumbnail.png").status, 404U);
    EXPECT_EQ(http(port(), "GET", "/api/scenes/none/thumbnail.png").status, 404U);
    EXPECT_NE(http(port(), "GET", "/api/scenes/tinny/thumbnail.png").body.find("mean tiny?"),
              std::string::npos);
    fs::create_directory(scenes_.path() / "tiny.relume/view");
    std::ofstream(scenes_.path() / "tiny.relume/view/thumbnail.png") << "png";
    const HttpAnswer answer = http(port(), "GET", "/api/scenes/tiny/thumbnail.png");
    EXPECT_EQ(answer.status, 200U);
    EXPECT_EQ(answer.body, "png");
    EXPECT_NE(answer.head.find("Content-Type: image/png"), std::string::npos);
}

TEST_F(HttpTest, PreviewsOfEnvironments) {
    start();
    const HttpAnswer answer =
        http(port(), "GET", "/api/environments/studio-softboxes/preview.jpg");
    EXPECT_EQ(answer.status, 200U);
    EXPECT_EQ(answer.body.substr(0, 2), "\xFF\xD8");
    const HttpAnswer missing = http(port(), "GET", "/api/environments/none/preview.jpg");
    EXPECT_EQ(missing.status, 404U);
    EXPECT_EQ(json::parse(missing.body)["error"]["code"], "not_found");
}

TEST_F(HttpTest, UploadsAreDecodedAndListed) {
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

TEST_F(HttpTest, ParametersThatAreUnknownOrWrongAreRefusedByName) {
    start();
    const auto fault = [](const HttpAnswer& answer) {
        const json error = json::parse(answer.body)["error"];
        return std::to_string(answer.status) + " " + error["code"].get<std::string>() + " " +
               error["found"].get<std::string>();
    };
    for (const char* path :
         {"/healthz", "/readyz", "/metrics", "/api/scenes", "/api/environments",
          "/api/scenes/tiny/thumbnail.png", "/api/environments/small/preview.jpg"}) {
        EXPECT_EQ(fault(http(port(), "GET", std::string(path) + "?size=2")),
                  "400 unknown_field the parameter \"size\"")
            << path;
    }
    EXPECT_EQ(fault(upload("?name=mine&projektion=lat_long", hdr_file())),
              "400 unknown_field the parameter \"projektion\"");
    const auto session = [&](const std::string& query) {
        return fault(http_raw(port(), upgrade_request("/session/r?scene=tiny" + query)));
    };
    EXPECT_EQ(session("&image=all"), "400 unknown_field the parameter \"image\"");
    EXPECT_EQ(session("&images=none"), "400 unknown_name none");
    EXPECT_EQ(session("&images="), "400 unknown_name ");
    EXPECT_EQ(http(port(), "GET", "/?scene=tiny&room=r").status, 200U);
    expect_serves_on();
}

TEST_F(HttpTest, BadUploadsGetNamedErrors) {
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

TEST_F(HttpTest, UploadsAskForTheToken) {
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

TEST_F(HttpTest, ClientsThatAskWhetherToGoOnAreAnswered) {
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

TEST_F(HttpTest, ThePageHasNoWayOut) {
    const fs::path root = scenes_.path() / "page";
    fs::create_directory(root);
    std::ofstream(root / "index.html") << "<title>page</title>";
    std::ofstream(scenes_.path() / "secret") << "secret";
    configuration_.web_root = root;
    start();
    const HttpAnswer page = http(port(), "GET", "/");
    EXPECT_EQ(page.body, "<title>page</title>");
    EXPECT_NE(page.head.find("X-Content-Type-Options: nosniff"), std::string::npos);
    EXPECT_EQ(http(port(), "GET", "/../secret").status, 400U);
    EXPECT_EQ(http(port(), "GET", "/%2e%2e/secret").status, 400U);
    EXPECT_EQ(http(port(), "GET", "/..%2fsecret").status, 400U);
    EXPECT_EQ(http(port(), "GET", "//secret.txt").status, 404U);
    EXPECT_TRUE(http(port(), "HEAD", "/").body.empty());

    const std::string tag_field = "ETag: ";
    const std::size_t tag = page.head.find(tag_field) + tag_field.size();
    const std::string etag = page.head.substr(tag, page.head.find("\r\n", tag) - tag);
    EXPECT_EQ(http(port(), "GET", "/", "If-None-Match: " + etag + "\r\n").status, 304U);
}

// A page elsewhere whose name was made to point here has our address, but not our name.
TEST_F(HttpTest, AnotherNamesHostIsRefusedWhateverItAsksFor) {
    configuration_.allow_hosts = {"studio.example"};
    start();
    const auto status = [this](const std::string& host, const std::string& target) {
        return http_raw(port(), "GET " + target + " HTTP/1.1\r\nHost: " + host +
                                    "\r\nConnection: close\r\n\r\n")
            .status;
    };
    for (const char* const host : {"evil.example", "evil.example:80", "localhost.evil.example",
                                   "127.0.0.1.evil.example", "10.1.2.3", "", "a b", "[::1"}) {
        EXPECT_EQ(status(host, "/api/scenes"), 421U) << host;
        EXPECT_EQ(status(host, "/"), 421U) << host;
    }
    for (const char* const host : {"localhost", "LOCALHOST.:1", "127.0.0.1", "127.0.0.1:65535",
                                   "[::1]:80", "studio.example", "Studio.Example:443"}) {
        EXPECT_EQ(status(host, "/api/scenes"), 200U) << host;
    }
}

TEST_F(HttpTest, AnswersSayWhatAPageMayDo) {
    start();
    for (const char* const target : {"/", "/api/scenes", "/api/none"}) {
        const std::string head = http(port(), "GET", target).head;
        EXPECT_NE(head.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
        EXPECT_NE(head.find("frame-ancestors 'none'"), std::string::npos);
        EXPECT_NE(head.find("X-Content-Type-Options: nosniff"), std::string::npos);
        EXPECT_NE(head.find("Referrer-Policy: no-referrer"), std::string::npos);
    }
}

TEST_F(HttpTest, WithoutAPageSaysSo) {
    start();
    EXPECT_NE(http(port(), "GET", "/").body.find("--web-root"), std::string::npos);
}

TEST_F(HttpTest, MethodsAndPathsThatAreNot) {
    start();
    EXPECT_EQ(http(port(), "PUT", "/api/scenes").status, 405U);
    EXPECT_EQ(http(port(), "DELETE", "/").status, 405U);
    EXPECT_EQ(http(port(), "POST", "/healthz").status, 405U);
    EXPECT_EQ(http(port(), "GET", "/api/none").status, 404U);
    EXPECT_EQ(http(port(), "GET", "/session/r?scene=tiny").status, 426U);
    EXPECT_EQ(http(port(), "GET", "/missing.js").status, 404U);
}

TEST_F(HttpTest, OnlyAllowedOriginsMayReadAnswers) {
    configuration_.allow_origins = {"http://dev.example"};
    start();
    const auto head = [this](const std::string& origin) {
        return http(port(), "GET", "/api/scenes", "Origin: " + origin + "\r\n").head;
    };
    EXPECT_NE(
        head("http://dev.example").find("Access-Control-Allow-Origin: http://dev.example\r\n"),
        std::string::npos);
    EXPECT_EQ(head("http://evil.example").find("Access-Control"), std::string::npos);
}

TEST_F(HttpTest, RequestsOnOneConnectionAreAnsweredInOrder) {
    start();
    RawSocket socket(port());
    socket.send(
        "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        "GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        "GET /api/none HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    const std::string answers = socket.receive_all();
    const std::size_t ok = answers.find("\r\n\r\nok\n");
    const std::size_t ready = answers.find("\r\n\r\nready\n");
    const std::size_t missing = answers.find("HTTP/1.1 404");
    ASSERT_NE(missing, std::string::npos);
    EXPECT_LT(ok, ready);
    EXPECT_LT(ready, missing);
}

// Boost 1.81 takes Content-Length with Transfer-Encoding and does not bound chunk headers.
TEST_F(HttpTest, BodiesWithTransferEncodingAreRefused) {
    start();
    const std::string begin =
        "POST /api/environments?name=mine HTTP/1.1\r\nHost: localhost\r\n";
    for (const char* const fields :
         {"Transfer-Encoding: chunked\r\n", "Transfer-Encoding: gzip, chunked\r\n",
          "Transfer-Encoding: identity\r\n"}) {
        const HttpAnswer answer = http_raw(port(), begin + fields + "\r\n0\r\n\r\n");
        EXPECT_TRUE(answer.status == 501 || answer.status == 400) << fields;
    }
    const HttpAnswer both = http_raw(
        port(), begin + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n");
    EXPECT_GE(both.status, 400U);
    const HttpAnswer endless = http_raw(
        port(), begin + "Transfer-Encoding: chunked\r\n\r\n5;" + std::string(200'000, 'x'));
    EXPECT_GE(endless.status, 400U);
    expect_serves_on();
}

TEST_F(HttpTest, RequestsThatAreNoneAreRefusedAndHoldNothing) {
    configuration_.connection.request_header_bytes = 4096;
    start();
    const std::string end = "\r\nHost: localhost\r\n\r\n";
    EXPECT_EQ(http_raw(port(), "GET / HTTP/1.1\r\n\r\n").status, 400U);
    EXPECT_EQ(http_raw(port(), "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n").status, 400U);
    EXPECT_EQ(http_raw(port(), "GET http://h/ HTTP/1.1" + end).status, 400U);
    EXPECT_EQ(http_raw(port(), "GET / HTTP/9.9" + end).status, 400U);
    EXPECT_EQ(http_raw(port(), "nonsense\r\n\r\n").status, 400U);
    EXPECT_EQ(http_raw(port(), std::string("\x16\x03\x01\x02\x00\x01\x00\x01", 8) +
                                   std::string(64, '\xAA') + "\r\n\r\n")
                  .status,
              400U);
    EXPECT_EQ(http_raw(port(), "GET / HTTP/1.1\r\nContent-Length: 5" + end + "hello").status,
              400U);
    EXPECT_EQ(http_raw(port(), "GET / HTTP/1.1\r\nContent-Length: -5" + end).status, 400U);
    EXPECT_EQ(http_raw(port(), "GET / HTTP/1.1\r\nX: " + std::string(10'000, 'x') + end).status,
              431U);
    EXPECT_EQ(http_raw(port(),
                       "POST /api/environments?name=m HTTP/1.1\r\n"
                       "Content-Length: 18446744073709551615" +
                           end)
                  .status,
              413U);
    expect_serves_on();
}

TEST_F(HttpTest, SlowRequestsAreCutOff) {
    configuration_.connection.request_timeout = std::chrono::milliseconds(50);
    configuration_.connection.body_timeout = std::chrono::milliseconds(50);
    start();
    RawSocket header(port());
    header.send("GET / HTTP/1.1\r\nHost:");
    EXPECT_EQ(header.receive_all(), "");
    RawSocket body(port());
    body.send(
        "POST /api/environments?name=m HTTP/1.1\r\nHost: localhost\r\nContent-Length: "
        "9\r\n\r\nab");
    EXPECT_EQ(body.receive_all(), "");
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_connections 0"); }));
    expect_serves_on();
}

// Bytes that come in time earn more of it, up to the whole; a trickle earns none.
TEST_F(HttpTest, UploadsThatTrickleAreCutOff) {
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

TEST_F(HttpTest, ConnectionsBeyondTheBoundAreClosedAtOnce) {
    configuration_.connection.connections = 2;
    start();
    RawSocket first(port());
    RawSocket second(port());
    EXPECT_TRUE(eventually([&] { return metrics_say("relume_connections 2"); }));
    RawSocket third(port());
    EXPECT_EQ(third.receive_all(), "");
    EXPECT_TRUE(metrics_say("relume_connections_refused_total 1"));
    first.end_sending();
    EXPECT_EQ(first.receive_all(), "");
    EXPECT_TRUE(eventually([&] { return http(port(), "GET", "/healthz").status == 200; }));
}

}  // namespace
}  // namespace relume::net
