// Requests that no client should make; some that Beast 1.81 must be kept from.
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <string>

namespace relume::net {
namespace {

using HostileRequest = RunningServer;

// Boost 1.81 takes Content-Length with Transfer-Encoding and does not bound chunk headers.
TEST_F(HostileRequest, BodiesWithTransferEncodingAreRefused) {
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

TEST_F(HostileRequest, RequestsThatAreNoneAreRefusedAndHoldNothing) {
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

TEST_F(HostileRequest, SlowRequestsAreCutOff) {
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

TEST_F(HostileRequest, ConnectionsBeyondTheBoundAreClosedAtOnce) {
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
