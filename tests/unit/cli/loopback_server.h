// A WebSocket peer on the loopback for one connection: plays the server's part frame by frame,
// so that a test can say what no well-behaved server would.
#pragma once

#include "client/cli/url.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>

namespace relume::cli {

class LoopbackPeer {
  public:
    virtual ~LoopbackPeer() = default;
    virtual void send_text(std::string_view text) = 0;
    virtual void send_binary(std::span<const std::byte> frame) = 0;
    // Empty when the client has closed.
    [[nodiscard]] virtual std::string receive() = 0;
    virtual void close(std::uint16_t code, const std::string& reason) = 0;
};

class LoopbackServer {
  public:
    using Play = std::function<void(LoopbackPeer&)>;

    // Accepts one WebSocket, runs `play` on a thread of its own, then closes.
    explicit LoopbackServer(Play play);
    // Accepts one connection, reads a request's header, answers with these bytes.
    explicit LoopbackServer(std::string raw_answer);
    ~LoopbackServer();
    LoopbackServer(const LoopbackServer&) = delete;
    LoopbackServer& operator=(const LoopbackServer&) = delete;
    LoopbackServer(LoopbackServer&&) = delete;
    LoopbackServer& operator=(LoopbackServer&&) = delete;

    [[nodiscard]] Url url() const;
    // The request line of the upgrade or request, once the thread has ended.
    [[nodiscard]] std::string wait_for_request();

  private:
    struct Socket;
    std::unique_ptr<Socket> socket_;
    std::string request_;
    std::thread thread_;
};

}  // namespace relume::cli
