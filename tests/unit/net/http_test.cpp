// What each path answers.
#include "protocol/wire/offered_material.h"
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/small_materials.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

using HttpTest = RunningServer;

TEST_F(HttpTest, HealthReadinessMetrics) {
    start();
    EXPECT_EQ(http(port(), "GET", "/healthz").status, 200U);
    EXPECT_EQ(http(port(), "GET", "/readyz").status, 200U);
    const HttpAnswer metrics = http(port(), "GET", "/metrics");
    EXPECT_EQ(metrics.status, 200U);
    EXPECT_NE(metrics.body.find("# TYPE relume_rooms gauge"), std::string::npos);
    EXPECT_NE(metrics.body.find("relume_relight_seconds_bucket"), std::string::npos);
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

// What is offered follows the folder, without a restart.
TEST_F(HttpTest, MaterialsOfTheFolder) {
    const test::ScratchDirectory materials;
    write_small_material(materials.path(), "white", materials::lambert_model());
    configuration_.materials = materials.path();
    configuration_.scenes_interval = std::chrono::milliseconds(5);
    start();
    const auto names = [&] {
        std::vector<std::string> found;
        const json offer = json::parse(http(port(), "GET", "/api/materials").body);
        for (const json& material : offer.at("materials")) {
            found.push_back(wire::offered_material_from_json(material, "").name);
        }
        return found;
    };
    EXPECT_EQ(names(), std::vector<std::string>{"white"});
    write_small_material(materials.path(), "phong-exponent-4", materials::phong_model(4));
    EXPECT_TRUE(eventually([&] {
        return names() == std::vector<std::string>{"phong", "white"};
    }));
}

TEST_F(HttpTest, NoFolderOfMaterialsIsNoMaterial) {
    start();
    EXPECT_EQ(http(port(), "GET", "/api/materials").body, R"({"materials":[]})");
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
          "/api/materials", "/api/scenes/tiny/thumbnail.png",
          "/api/environments/small/preview.jpg"}) {
        EXPECT_EQ(fault(http(port(), "GET", std::string(path) + "?size=2")),
                  "400 unknown_field the parameter \"size\"")
            << path;
    }
    EXPECT_EQ(fault(http(port(), "POST", "/api/environments?name=mine&projektion=lat_long")),
              "400 unknown_field the parameter \"projektion\"");
    const auto entering = [&](const std::string& query) {
        return fault(http_raw(port(), upgrade_request("/session/r?scene=tiny" + query)));
    };
    EXPECT_EQ(entering("&image=all"), "400 unknown_field the parameter \"image\"");
    EXPECT_EQ(entering("&images=none"), "400 unknown_name none");
    EXPECT_EQ(entering("&images="), "400 unknown_name ");
    EXPECT_EQ(http(port(), "GET", "/?scene=tiny&room=r").status, 200U);
    expect_serves_on();
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

}  // namespace
}  // namespace relume::net
