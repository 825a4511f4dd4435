// A TCP connection that may send anything, also what no well-meaning client would.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace relume::net {

class RawSocket {
  public:
    // `receive_buffer_bytes` 0 leaves the system's choice. All of 127.0.0.0/8 is this machine:
    // a connection may come from any of it. Throws std::runtime_error, as below.
    explicit RawSocket(std::uint16_t port,
                       int receive_buffer_bytes = 0,
                       const char* source = "127.0.0.1");
    RawSocket(const RawSocket&) = delete;
    RawSocket& operator=(const RawSocket&) = delete;
    ~RawSocket();

    // False when the peer has ended the connection.
    bool send(std::string_view bytes);
    void end_sending();
    // All until the peer ends, or until `end` has come.
    [[nodiscard]] std::string receive_until(std::string_view end);
    [[nodiscard]] std::string receive_all();
    // The peer has ended the connection, as far as has been heard without waiting.
    [[nodiscard]] bool has_ended() const;

  private:
    int socket_;
};

struct HttpAnswer {
    unsigned status = 0;  // 0 when there was none
    std::string head;
    std::string body;
};

// Sends the bytes as they are and reads to the end of the connection.
[[nodiscard]] HttpAnswer http_raw(std::uint16_t port, std::string_view request);
// `method target HTTP/1.1` with Host and `Connection: close`; fields end in CRLF each.
[[nodiscard]] HttpAnswer http(std::uint16_t port,
                              const std::string& method,
                              const std::string& target,
                              const std::string& fields = {},
                              const std::string& body = {});

// An upgrade into a room, and frames by hand [RFC 6455 §5.2].
[[nodiscard]] std::string upgrade_request(const std::string& target);
[[nodiscard]] std::string masked_text_frame(const std::string& text);

}  // namespace relume::net
