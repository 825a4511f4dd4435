#include "client/cli/room_connection.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/room_patch.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <random>

namespace relume::cli {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;

namespace {

// An unsent edit is stale already; far more of them than one sends in a second is a stall.
constexpr std::size_t kMaxQueuedMessages = 4096;

std::string target_of(const ConnectionOptions& options) {
    std::string target = fmt::format("{}/session/{}?images={}", options.server.prefix,
                                     percent_encoded(options.room),
                                     options.images == ImageChoice::all ? "all" : "settled");
    if (!options.scene.empty()) {
        target += "&scene=" + percent_encoded(options.scene);
    }
    return target;
}

// Four half planes, and what zstd adds where it cannot compress.
std::size_t largest_frame(const wire::ImageSize& image) {
    const std::size_t planes = std::size_t{8} * image.width * image.height;
    return wire::kMaxServerMessageBytes + planes + planes / 128;
}

// What the close frame says, or what its code means.
std::string text_from(const websocket::close_reason& close) {
    if (!close.reason.empty()) {
        return close.reason.c_str();
    }
    const auto code = wire::close_code_from_number(close.code);
    return code ? std::string(wire::reason_from_close_code(*code))
                : fmt::format("closed with code {}", close.code);
}

}  // namespace

class RoomConnection::Socket : public std::enable_shared_from_this<Socket> {
  public:
    Socket(asio::io_context& io, ConnectionOptions options, ConnectionListener listener)
        : options_(std::move(options)),
          listener_(std::move(listener)),
          strand_(asio::make_strand(io)),
          resolver_(strand_),
          stream_(strand_) {
        stream_.read_message_max(wire::kMaxServerMessageBytes);
    }

    void open() {
        resolver_.async_resolve(
            options_.server.host, options_.server.port,
            [self = shared_from_this()](error_code error,
                                        const tcp::resolver::results_type& found) {
                error ? self->end("resolving the host", error) : self->connect(found);
            });
    }

    std::uint64_t send_edit(nlohmann::json patch) {
        const std::uint64_t id = next_edit_id_++;
        clock_.edit_sent(id, Clock::now());
        send(text_from_message(wire::Edit{.id = id, .patch = std::move(patch)}));
        return id;
    }

    void close() {
        if (ended_ || closing_) {
            return;
        }
        closing_ = true;
        if (!stream_.is_open()) {
            resolver_.cancel();
            beast::get_lowest_layer(stream_).cancel();
            return;
        }
        stream_.async_close(websocket::close_code::normal,
                            [self = shared_from_this()](error_code) {
                                // The read that is under way ends with the connection and
                                // reports it.
                            });
    }

    [[nodiscard]] asio::any_io_executor executor() const { return strand_; }

  private:
    void connect(const tcp::resolver::results_type& found) {
        auto& tcp_stream = beast::get_lowest_layer(stream_);
        tcp_stream.expires_after(options_.connect_timeout);
        tcp_stream.async_connect(
            found, [self = shared_from_this()](error_code error, const auto&) {
                error ? self->end("connecting", error) : self->shake_hands();
            });
    }

    void shake_hands() {
        auto& tcp_stream = beast::get_lowest_layer(stream_);
        error_code ignored;
        tcp_stream.socket().set_option(tcp::no_delay(true), ignored);
        // The TCP stream times the handshake: Beast's WebSocket timer goes on after a refused
        // one, and would keep the io_context busy to its end.
        tcp_stream.expires_after(options_.connect_timeout);
        stream_.set_option(websocket::stream_base::decorator(
            [token = options_.token](websocket::request_type& request) {
                request.set(beast::http::field::sec_websocket_protocol, "relume.v1");
                if (!token.empty()) {
                    request.set(beast::http::field::authorization, "Bearer " + token);
                }
            }));
        stream_.async_handshake(
            refusal_, options_.server.authority(), target_of(options_),
            [self = shared_from_this()](error_code error) {
                if (error) {
                    self->end(
                        self->refusal_.result_int() >= 400
                            ? fmt::format("WebSocket upgrade, HTTP status {}: {}",
                                          self->refusal_.result_int(), self->refusal_.body())
                            : "WebSocket upgrade",
                        error);
                } else {
                    self->opened();
                }
            });
    }

    void opened() {
        beast::get_lowest_layer(stream_).expires_never();
        auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::client);
        timeout.handshake_timeout = options_.connect_timeout;  // of closing, too
        stream_.set_option(timeout);
        read();
    }

    void read() {
        stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
            self->received(error);
        });
    }

    void received(error_code error) {
        const Clock::time_point now = Clock::now();
        if (error) {
            end("reading", error);
            return;
        }
        if (closing_) {
            buffer_.consume(buffer_.size());
            read();
            return;
        }
        try {
            const auto bytes = buffer_.cdata();
            if (stream_.got_text()) {
                take_message({static_cast<const char*>(bytes.data()), bytes.size()});
            } else {
                take_image({static_cast<const std::byte*>(bytes.data()), bytes.size()}, now);
            }
        } catch (const wire::WireError& refusal) {
            if (refusal.code() != wire::ErrorCode::unknown_type) {
                end_with({.was_open = open_,
                          .reason = fmt::format("the server sent {}", refusal.what())});
                return;
            }
        }
        buffer_.consume(buffer_.size());
        read();
    }

    void take_message(std::string_view text) {
        const wire::ServerMessage message = wire::parse_server_message(text);
        if (const auto* snapshot = std::get_if<wire::Snapshot>(&message)) {
            // Later ones stand in the place of changes, and say nothing else that is new.
            if (!open_) {
                open_ = true;
                expect_images_of(snapshot->state.image, snapshot->revision);
                listener_.on_snapshot(*snapshot);
            }
        } else if (const auto* change = std::get_if<wire::Change>(&message)) {
            if (change->edit_id) {
                clock_.change_received(*change->edit_id, change->revision);
            }
            if (change->patch.contains("image")) {
                wire::RoomState after;
                after.image = image_;
                wire::apply_patch(after, {{"image", change->patch["image"]}}, {});
                expect_images_of(after.image, change->revision);
            }
            listener_.on_change(*change);
        } else if (const auto* refusal = std::get_if<wire::ErrorMessage>(&message)) {
            if (refusal->edit_id) {
                clock_.edit_refused(*refusal->edit_id);
            }
            listener_.on_error(*refusal);
        }
    }

    void expect_images_of(const wire::ImageSize& image, std::uint64_t revision) {
        stream_.read_message_max(std::max(largest_frame(image_), largest_frame(image)));
        image_ = image;
        image_revision_ = revision;
    }

    void take_image(std::span<const std::byte> frame, Clock::time_point now) {
        const wire::ImageHeader header = wire::decode_image_header(frame);
        const bool has_size = header.width == image_.width && header.height == image_.height;
        if (!has_size && header.revision >= image_revision_) {
            throw wire::WireError(
                wire::ErrorCode::bad_image, "width",
                fmt::format("{}×{}", header.width, header.height),
                fmt::format("{}×{}, the room's", image_.width, image_.height));
        }
        const auto payload = frame.subspan(wire::kImageHeaderBytes);
        listener_.on_image({.header = header,
                            .payload = {payload.begin(), payload.end()},
                            .received = now,
                            .edit_to_image_ms = clock_.image_received(header.revision, now)});
        send(text_from_message(wire::Ack{.sequence = header.sequence}));
    }

    void send(std::string text) {
        if (ended_ || closing_) {
            return;
        }
        if (queue_.size() == kMaxQueuedMessages) {
            end_with({.was_open = open_,
                      .reason = fmt::format("the server does not take messages: {} wait",
                                            queue_.size())});
            return;
        }
        queue_.push_back(std::move(text));
        if (queue_.size() == 1) {
            write();
        }
    }

    void write() {
        stream_.text(true);
        stream_.async_write(asio::buffer(queue_.front()),
                            [self = shared_from_this()](error_code error, std::size_t) {
                                if (error) {
                                    return;  // reading fails too, and reports
                                }
                                self->queue_.pop_front();
                                if (!self->queue_.empty() && !self->closing_) {
                                    self->write();
                                }
                            });
    }

    void end(const std::string& doing, error_code error) {
        if (error == websocket::error::closed) {
            end_with({.was_open = open_, .reason = text_from(stream_.reason())});
            return;
        }
        end_with({.was_open = open_,
                  .reason = fmt::format("http://{}: {}: {}", options_.server.authority(), doing,
                                        error.message())});
    }

    void end_with(const ConnectionEnd& how) {
        if (!std::exchange(ended_, true)) {
            beast::get_lowest_layer(stream_).close();
            listener_.on_end(how);
        }
    }

    ConnectionOptions options_;
    ConnectionListener listener_;
    asio::strand<asio::io_context::executor_type> strand_;
    tcp::resolver resolver_;
    websocket::stream<beast::tcp_stream> stream_;
    websocket::response_type refusal_;
    beast::flat_buffer buffer_;
    std::deque<std::string> queue_;
    EditClock clock_;
    wire::ImageSize image_;             // of images
    std::uint64_t image_revision_ = 0;  // since this revision
    std::uint64_t next_edit_id_ = 1;
    bool open_ = false;
    bool closing_ = false;
    bool ended_ = false;
};

RoomConnection::RoomConnection(asio::io_context& io,
                               ConnectionOptions options,
                               ConnectionListener listener)
    : socket_(std::make_shared<Socket>(io, std::move(options), std::move(listener))) {}

RoomConnection::~RoomConnection() = default;

void RoomConnection::open() {
    socket_->open();
}

std::uint64_t RoomConnection::send_edit(nlohmann::json patch) {
    return socket_->send_edit(std::move(patch));
}

void RoomConnection::close() {
    socket_->close();
}

asio::any_io_executor RoomConnection::executor() const {
    return socket_->executor();
}

std::string random_room_name(const std::string& prefix) {
    std::random_device random;
    const std::uint64_t digits = (std::uint64_t{random()} << 32U) | random();
    return fmt::format("{}-{:016x}", prefix, digits);
}

}  // namespace relume::cli
