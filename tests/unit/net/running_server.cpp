#include "tests/unit/net/running_server.h"

#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

namespace relume::net {

void RunningServer::expect_serves_on() {
    EXPECT_EQ(http(port(), "GET", "/healthz").status, 200U);
    WebSocketClient client(port(), "/session/newcomer?scene=tiny&images=settled");
    const nlohmann::json snapshot = client.receive_message("snapshot");
    const std::uint64_t revision = snapshot["revision"];
    client.send(nlohmann::json{
        {"type", "edit"}, {"id", 1}, {"patch", {{"environment", {{"gain", 2}}}}}});
    EXPECT_TRUE(client.receive_settled(revision + 1).image_header().exact);
}

}  // namespace relume::net
