#include "tests/unit/net/raw_socket.h"

#include "tests/unit/net/waiting.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>

namespace relume::net {

RawSocket::RawSocket(std::uint16_t port, int receive_buffer_bytes, const char* source)
    : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer_bytes > 0) {
        setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes,
                   sizeof receive_buffer_bytes);
    }
    sockaddr_in own{};
    own.sin_family = AF_INET;
    inet_pton(AF_INET, source, &own.sin_addr);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 ||
        ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        ::close(socket_);
        throw std::runtime_error("cannot connect");
    }
}

RawSocket::~RawSocket() {
    ::close(socket_);
}

bool RawSocket::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) {
            return false;
        }
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

void RawSocket::end_sending() {
    ::shutdown(socket_, SHUT_WR);
}

std::string RawSocket::receive_until(std::string_view end) {
    std::string received;
    std::array<char, 4096> chunk{};
    while (end.empty() || received.find(end) == std::string::npos) {
        pollfd ready{.fd = socket_, .events = POLLIN, .revents = 0};
        const auto timeout = std::chrono::milliseconds(kDeadline).count();
        if (::poll(&ready, 1, static_cast<int>(timeout)) <= 0) {
            throw std::runtime_error("the server has not answered in time");
        }
        const ssize_t count = ::recv(socket_, chunk.data(), chunk.size(), 0);
        if (count <= 0) {
            break;
        }
        received.append(chunk.data(), static_cast<std::size_t>(count));
    }
    return received;
}

bool RawSocket::has_ended() const {
    char byte = 0;
    const ssize_t count = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
}

std::string RawSocket::receive_all() {
    return receive_until({});
}

HttpAnswer http_raw(std::uint16_t port, std::string_view request) {
    RawSocket socket(port);
    socket.send(request);
    const std::string bytes = socket.receive_all();
    HttpAnswer answer;
    const std::size_t head_end = bytes.find("\r\n\r\n");
    if (!bytes.starts_with("HTTP/1.1 ") || head_end == std::string::npos) {
        return answer;
    }
    answer.status = static_cast<unsigned>(std::strtoul(bytes.c_str() + 9, nullptr, 10));
    answer.head = bytes.substr(0, head_end + 2);
    answer.body = bytes.substr(head_end + 4);
    return answer;
}

HttpAnswer http(std::uint16_t port,
                const std::string& method,
                const std::string& target,
                const std::string& fields,
                const std::string& body) {
    std::string request = method + " " + target +
                          " HTTP/1.1\r\nHost: localhost:" + std::to_string(port) +
                          "\r\nConnection: close\r\n" + fields;
    if (!body.empty()) {
        request += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    }
    return http_raw(port, request + "\r\n" + body);
}

std::string upgrade_request(const std::string& target) {
    return "GET " + target +
           " HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

std::string masked_text_frame(const std::string& text) {
    std::string frame = "\x81";
    frame.push_back(static_cast<char>(0x80U | text.size()));  // below 126
    frame.append(4, '\0');                                    // a mask that changes nothing
    return frame + text;
}

}  // namespace relume::net
