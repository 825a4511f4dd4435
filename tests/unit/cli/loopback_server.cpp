#include "tests/unit/cli/loopback_server.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace relume::cli {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;

namespace {

class Peer final : public LoopbackPeer {
  public:
    explicit Peer(websocket::stream<tcp::socket>& stream) : stream_(stream) {}

    void send_text(std::string_view text) override {
        beast::error_code ignored;  // the client may have left; receive() tells
        stream_.text(true);
        stream_.write(asio::buffer(text), ignored);
    }
    void send_binary(std::span<const std::byte> frame) override {
        beast::error_code ignored;
        stream_.binary(true);
        stream_.write(asio::buffer(frame.data(), frame.size()), ignored);
    }
    std::string receive() override {
        beast::flat_buffer buffer;
        beast::error_code error;
        stream_.read(buffer, error);
        return error ? std::string() : beast::buffers_to_string(buffer.cdata());
    }
    void close(std::uint16_t code, const std::string& reason) override {
        beast::error_code ignored;
        stream_.close(websocket::close_reason(websocket::close_code(code), reason), ignored);
    }

  private:
    websocket::stream<tcp::socket>& stream_;
};

}  // namespace

struct LoopbackServer::Socket {
    asio::io_context io;
    tcp::acceptor acceptor{io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
};

LoopbackServer::LoopbackServer(Play play) : socket_(std::make_unique<Socket>()) {
    thread_ = std::thread([this, play = std::move(play)] {
        beast::error_code error;
        tcp::socket socket(socket_->io);
        socket_->acceptor.accept(socket, error);
        beast::flat_buffer buffer;
        beast::http::request<beast::http::string_body> request;
        beast::http::read(socket, buffer, request, error);
        request_ = std::string(request.target());
        websocket::stream<tcp::socket> stream(std::move(socket));
        stream.accept(request, error);
        if (!error) {
            Peer peer(stream);
            play(peer);
            peer.close(1000, "");
        }
    });
}

LoopbackServer::LoopbackServer(std::string raw_answer) : socket_(std::make_unique<Socket>()) {
    thread_ = std::thread([this, raw_answer = std::move(raw_answer)] {
        beast::error_code error;
        tcp::socket socket(socket_->io);
        socket_->acceptor.accept(socket, error);
        asio::streambuf header;
        asio::read_until(socket, header, "\r\n\r\n", error);
        request_ = beast::buffers_to_string(header.data());
        asio::write(socket, asio::buffer(raw_answer), error);
        socket.shutdown(tcp::socket::shutdown_send, error);
        // Closing with unread data would reset the connection before the answer is read.
        std::string rest(4096, '\0');
        while (!error) {
            socket.read_some(asio::buffer(rest), error);
        }
    });
}

LoopbackServer::~LoopbackServer() {
    if (thread_.joinable()) {
        // A client that never came must not leave the thread in accept().
        beast::error_code ignored;
        tcp::socket socket(socket_->io);
        socket.connect(socket_->acceptor.local_endpoint(), ignored);
        socket.close(ignored);
        thread_.join();
    }
}

Url LoopbackServer::url() const {
    return {"127.0.0.1", std::to_string(socket_->acceptor.local_endpoint().port()), ""};
}

std::string LoopbackServer::wait_for_request() {
    thread_.join();
    return request_;
}

}  // namespace relume::cli
