#include "tests/unit/net/websocket_client.h"

#include "tests/unit/net/waiting.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

#include <span>
#include <stdexcept>

namespace relume::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;

struct WebSocketClient::Connection {
    asio::io_context io;
    websocket::stream<tcp::socket> socket{io};
    bool open = true;

    // Runs what was just begun until it has called `done`.
    void finish(const bool& done) {
        io.restart();
        io.run_for(kDeadline);
        if (!done) {
            throw std::runtime_error("the server has not answered in time");
        }
    }

    void write(bool binary, const std::string& bytes) {
        bool done = false;
        beast::error_code error;
        socket.binary(binary);
        socket.async_write(asio::buffer(bytes), [&](const beast::error_code& e, std::size_t) {
            error = e;
            done = true;
        });
        finish(done);
        open = open && !error;
    }
};

wire::ImageHeader WebSocketClient::Frame::image_header() const {
    return wire::decode_image_header(std::as_bytes(std::span(bytes)));
}

WebSocketClient::WebSocketClient(std::uint16_t port,
                                 const std::string& target,
                                 const Fields& fields)
    : connection_(std::make_unique<Connection>()) {
    auto& socket = connection_->socket;
    socket.next_layer().connect({asio::ip::address_v4::loopback(), port});
    socket.read_message_max(std::size_t{64} << 20);
    socket.set_option(websocket::stream_base::decorator([fields](auto& request) {
        for (const auto& [name, value] : fields) {
            request.set(name, value);
        }
    }));
    bool done = false;
    beast::error_code error;
    websocket::response_type response;
    socket.async_handshake(response, "localhost:" + std::to_string(port), target,
                           [&](const beast::error_code& e) {
                               error = e;
                               done = true;
                           });
    connection_->finish(done);
    if (error) {
        throw std::runtime_error("refused with " + std::to_string(response.result_int()));
    }
}

WebSocketClient::~WebSocketClient() = default;

void WebSocketClient::send(const std::string& text) {
    connection_->write(false, text);
}
void WebSocketClient::send(const nlohmann::json& message) {
    send(message.dump());
}
void WebSocketClient::send_binary(const std::string& bytes) {
    connection_->write(true, bytes);
}

void WebSocketClient::acknowledge(std::uint64_t sequence) {
    send(nlohmann::json{{"type", "ack"}, {"sequence", sequence}});
}

std::optional<WebSocketClient::Frame> WebSocketClient::receive() {
    if (!connection_->open) {
        return std::nullopt;
    }
    bool done = false;
    beast::error_code error;
    beast::flat_buffer buffer;
    connection_->socket.async_read(buffer, [&](const beast::error_code& e, std::size_t) {
        error = e;
        done = true;
    });
    connection_->finish(done);
    if (error) {
        connection_->open = false;
        return std::nullopt;
    }
    return Frame{.binary = connection_->socket.got_binary(),
                 .bytes = beast::buffers_to_string(buffer.data())};
}

nlohmann::json WebSocketClient::receive_message(const std::string& type) {
    while (const std::optional<Frame> frame = receive()) {
        if (frame->binary) {
            acknowledge(frame->image_header().sequence);
            continue;
        }
        nlohmann::json message = nlohmann::json::parse(frame->bytes);
        if (message["type"] == type) {
            return message;
        }
    }
    throw std::runtime_error("the connection ended before a message of type " + type);
}

WebSocketClient::Frame WebSocketClient::receive_settled(std::uint64_t revision) {
    while (std::optional<Frame> frame = receive()) {
        if (!frame->binary) {
            continue;
        }
        const wire::ImageHeader header = frame->image_header();
        acknowledge(header.sequence);
        if (header.encoding == wire::ImageEncoding::half_planes &&
            header.revision >= revision) {
            return *std::move(frame);
        }
    }
    throw std::runtime_error("the connection ended before a settled image");
}

unsigned WebSocketClient::receive_close() {
    while (receive()) {
    }
    return connection_->socket.reason().code;
}

void WebSocketClient::vanish() {
    beast::error_code ignored;
    connection_->socket.next_layer().set_option(asio::socket_base::linger(true, 0), ignored);
    connection_->socket.next_layer().close(ignored);
    connection_->open = false;
}

}  // namespace relume::net
