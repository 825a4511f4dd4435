// What one TCP connection may cost, besides wire::Limits.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace relume::net {

struct ConnectionOptions {
    std::size_t connections = 1024;  // open at once, of all kinds
    // Of these, so many for clients of one address. Connections of a trusted proxy do not
    // count.
    std::size_t connections_per_address = 256;
    std::uint32_t request_header_bytes = 16 * 1024;
    // What the system may hold of data sent and not yet received, per connection (it takes
    // twice that). Its own choice would be megabytes for each client that reads slowly.
    std::size_t send_buffer_bytes = 512 * 1024;
    std::size_t concurrent_uploads = 4;  // bodies being read or decoded
    std::size_t uploads_per_address = 2;
    std::uint64_t upload_texels = std::uint64_t{8192} * 4096;
    // From the first wait for a request to its last header byte: idle connections end so too.
    std::chrono::milliseconds request_timeout{std::chrono::seconds(20)};
    std::chrono::milliseconds body_timeout{std::chrono::seconds(120)};
    // A body has body_grace to begin with, and more as its bytes come at this rate.
    std::chrono::milliseconds body_grace{std::chrono::seconds(10)};
    std::uint64_t body_bytes_per_second = 16 * 1024;
    // One write that makes no end for so long means a peer that does not read …
    std::chrono::milliseconds write_timeout{std::chrono::seconds(20)};
    // … and after so long more it is not waited for.
    std::chrono::milliseconds write_grace{std::chrono::seconds(10)};
    std::chrono::milliseconds handshake_timeout{std::chrono::seconds(10)};  // of open and close
    // A WebSocket from which nothing came for so long, pongs included, is dead.
    std::chrono::milliseconds silence_timeout{std::chrono::seconds(60)};
};

}  // namespace relume::net
