// Clients that do what none should. Each gets a named end, and the server serves on.
#pragma once

#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/running_server.h"
#include "tests/unit/net/websocket_client.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace relume::net {

class HostileClient : public RunningServer {
  protected:
    static constexpr const char* kTarget = "/session/r?scene=tiny";

    // The error that a text is answered with; the connection goes on after it.
    nlohmann::json error_for(const std::string& text) {
        WebSocketClient client(port(), kTarget);
        client.send(text);
        nlohmann::json error = client.receive_message("error");
        client.send(
            nlohmann::json{{"type", "edit"}, {"id", 9}, {"patch", nlohmann::json::object()}});
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

}  // namespace relume::net
