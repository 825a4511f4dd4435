// A client of a room as tests need it: one thread, every wait with a deadline.
#pragma once

#include "protocol/wire/image_header.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace relume::net {

class WebSocketClient {
  public:
    struct Frame {
        bool binary = false;
        std::string bytes;

        [[nodiscard]] wire::ImageHeader image_header() const;
    };
    using Fields = std::vector<std::pair<std::string, std::string>>;

    // Throws std::runtime_error if the upgrade is refused, here and below when a deadline
    // passes.
    WebSocketClient(std::uint16_t port, const std::string& target, const Fields& fields = {});
    ~WebSocketClient();

    void send(const std::string& text);
    void send(const nlohmann::json& message);
    void send_binary(const std::string& bytes);
    void acknowledge(std::uint64_t sequence);

    // The next frame; nothing once the connection has ended.
    [[nodiscard]] std::optional<Frame> receive();
    // The next text message of this type, images before it being acknowledged.
    [[nodiscard]] nlohmann::json receive_message(const std::string& type);
    // The next settled image of at least this revision; acknowledges all images.
    [[nodiscard]] Frame receive_settled(std::uint64_t revision);
    // Reads to the end; the code of the close frame, 0 if there was none.
    [[nodiscard]] unsigned receive_close();
    // Ends the connection without a word.
    void vanish();

  private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
};

}  // namespace relume::net
