#include "server/net/sockets/websocket_connection.h"

#include "protocol/wire/messages.h"
#include "server/net/http/subprotocols.h"
#include "server/net/peers/token_bucket.h"
#include "server/net/rooms/outbox.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace relume::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

using wire::CloseCode;

namespace {

constexpr auto kNoThrow = asio::as_tuple(asio::use_awaitable);
// Of those that mean something [RFC 6455 §7.4.2].
constexpr std::uint16_t kLargestCloseCode = 4999;
// Beside the code, of a frame of at most 125 bytes [RFC 6455 §5.5].
constexpr std::size_t kMaxCloseReasonBytes = 123;

// What is long takes long to read: a message counts once for every 4 KiB that it begins.
double weight_of_message(std::size_t bytes) {
    constexpr std::size_t kBytesOfOne = 4096;
    return static_cast<double>(
        std::max<std::size_t>(1, (bytes + kBytesOfOne - 1) / kBytesOfOne));
}

ImageInterest interest_of(const HttpRequest& request) {
    const std::optional<std::string> images = request.target.parameter("images");
    return images ? kImageInterestNames.value(*images).value_or(ImageInterest::all)
                  : ImageInterest::all;
}

// Reader and writer are two coroutines on one strand; the outbox between room and writer is
// all that other threads touch. Only the writer closes.
class WebSocketConnection : public std::enable_shared_from_this<WebSocketConnection> {
  public:
    WebSocketConnection(beast::tcp_stream stream,
                        HttpRequest request,
                        const ConnectionServices& services)
        : socket_(std::move(stream)),
          services_(services),
          request_(std::move(request)),
          outbox_(std::make_shared<Outbox>(interest_of(request_), services.limits)),
          wake_timer_(socket_.get_executor()),
          write_timer_(socket_.get_executor()),
          messages_(static_cast<double>(services.limits.messages_per_second),
                    static_cast<double>(services.limits.message_burst),
                    Clock::now()) {}

    asio::awaitable<void> run(http::request<http::empty_body> upgrade, std::string room_name) {
        configure();
        if (offers_subprotocol(request_.subprotocols)) {
            socket_.set_option(
                websocket::stream_base::decorator([](websocket::response_type& response) {
                    response.set(http::field::sec_websocket_protocol,
                                 beast::string_view(kSubprotocol.data(), kSubprotocol.size()));
                }));
        }
        auto [error] = co_await socket_.async_accept(upgrade, kNoThrow);
        if (error) {
            co_return;
        }
        enter(room_name);
        // The writer keeps this object alive by itself; whoever ends last ends the connection.
        auto self = shared_from_this();
        auto writer = [self]() -> asio::awaitable<void> { return self->write_all(); };
        asio::co_spawn(socket_.get_executor(), writer, asio::detached);
        if (room_) {
            co_await read_all();
            services_.rooms.leave(*room_, viewer_);
        }
        reading_ = false;
        wake_timer_.cancel();
        while (writing_) {
            done_waiting_.expires_at(Clock::time_point::max());
            co_await done_waiting_.async_wait(kNoThrow);
        }
    }

  private:
    void configure() {
        beast::get_lowest_layer(socket_).expires_never();
        beast::get_lowest_layer(socket_).socket().set_option(asio::ip::tcp::no_delay(true));
        websocket::stream_base::timeout timeout{};
        timeout.handshake_timeout = services_.options.handshake_timeout;
        timeout.idle_timeout = services_.options.silence_timeout;
        timeout.keep_alive_pings = true;
        socket_.set_option(timeout);
        socket_.read_message_max(static_cast<std::size_t>(services_.limits.message_bytes));
        // Images are one frame each, and never deflated: they are compressed already.
        socket_.auto_fragment(false);
        // Pings make work too.
        socket_.control_callback([this](websocket::frame_type type, beast::string_view) {
            if (!messages_.take(Clock::now())) {
                close(CloseCode::too_fast);
            }
            if (type == websocket::frame_type::close &&
                socket_.reason().code > kLargestCloseCode) {
                fail_for_close_code();
            }
        });
        std::weak_ptr<WebSocketConnection> weak = weak_from_this();
        auto executor = socket_.get_executor();
        outbox_->set_wake([weak, executor] {
            asio::post(executor, [weak] {
                if (const auto self = weak.lock()) {
                    self->wake_timer_.cancel();
                }
            });
        });
    }

    // Sets the room, or fills the outbox with the reason why not.
    void enter(const std::string& name) {
        auto entered = services_.rooms.enter(name, request_.target.parameter("scene"),
                                             {.role = services_.access.role_of(request_),
                                              .outbox = outbox_,
                                              .address = request_.client});
        if (const auto* const refusal = std::get_if<Rooms::Refusal>(&entered)) {
            expected_ = refusal->expected;
            close(refusal->code);
            return;
        }
        room_ = std::get<Rooms::Entered>(entered).room;
        viewer_ = std::get<Rooms::Entered>(entered).viewer;
    }

    // Beast 1.81 would send back what no peer may send. The answer that is begun here goes
    // before its own.
    void fail_for_close_code() {
        fails_ = true;
        socket_.async_close(websocket::close_code::protocol_error,
                            [self = shared_from_this()](const beast::error_code&) {});
    }

    void close(CloseCode code) {
        closing_ = true;
        outbox_->close(code);
    }

    asio::awaitable<void> read_all() {
        beast::flat_buffer buffer;
        while (true) {
            auto [error, bytes] = co_await socket_.async_read(buffer, kNoThrow);
            static_cast<void>(bytes);
            if (error) {
                break;
            }
            const Clock::time_point read_at = Clock::now();
            if (!socket_.got_text()) {
                close(CloseCode::not_text);
            } else if (!messages_.take(read_at, weight_of_message(buffer.size()))) {
                close(CloseCode::too_fast);
            } else if (!closing_) {
                const auto data = buffer.cdata();
                handle({static_cast<const char*>(data.data()), data.size()}, read_at);
            }
            buffer.consume(buffer.size());
        }
    }

    void handle(std::string_view text, Clock::time_point read_at) {
        std::optional<std::uint64_t> edit_id;
        try {
            wire::ClientMessage message = wire::parse_client_message(text, services_.limits);
            if (const wire::Ack* const ack = std::get_if<wire::Ack>(&message)) {
                room_->acknowledge(viewer_, ack->sequence);
                return;
            }
            if (const auto* const display = std::get_if<wire::DisplayChoice>(&message)) {
                outbox_->choose_display(*display);
                return;
            }
            const wire::Edit& edit = std::get<wire::Edit>(message);
            edit_id = edit.id;
            room_->edit(viewer_, edit, read_at);
        } catch (const wire::WireError& refusal) {
            refuse(edit_id ? refusal.with_edit_id(*edit_id) : refusal);
        }
    }

    void refuse(const wire::WireError& refusal) {
        services_.metrics.count_error(refusal.code());
        outbox_->put_error(wire::message_from_error(refusal));
        if (++errors_ >= services_.limits.errors_per_connection) {
            close(CloseCode::too_many_errors);
        }
    }

    asio::awaitable<void> write_all() {
        try {
            co_await write_until_done();
        } catch (const std::exception& failure) {
            spdlog::error("connection_failed reason={:?}", failure.what());
        }
        // Ends a read that still waits.
        beast::get_lowest_layer(socket_).close();
        writing_ = false;
        done_waiting_.cancel();
    }

    asio::awaitable<void> write_until_done() {
        bool more = true;
        while (more) {
            std::optional<Outbox::Item> item = outbox_->take();
            if (item) {
                more = co_await write(*item);
            } else if (reading_) {
                wake_timer_.expires_at(Clock::time_point::max());
                co_await wake_timer_.async_wait(kNoThrow);
            } else {
                more = false;
            }
        }
    }

    // False when this was the last.
    asio::awaitable<bool> write(const Outbox::Item& item) {
        if (const auto* const last = std::get_if<Outbox::Close>(&item)) {
            co_await send_close(last->code);
            co_return false;
        }
        asio::const_buffer bytes;
        if (const std::string* const text = std::get_if<std::string>(&item)) {
            socket_.text(true);
            bytes = asio::buffer(*text);
        } else {
            const auto& image = std::get<SharedImageFrame>(item);
            socket_.binary(true);
            bytes = asio::buffer(image->bytes);
        }
        watch_write();
        auto [error, sent] = co_await socket_.async_write(bytes, kNoThrow);
        write_timer_.cancel();
        services_.metrics.count_sent(sent);
        co_return !error;
    }

    asio::awaitable<void> send_close(CloseCode code) {
        if (fails_) {
            co_return;
        }
        services_.metrics.count_close(code);
        spdlog::info("viewer_closed room={} code={} reason={:?}", room_ ? room_->name() : "-",
                     static_cast<unsigned>(code), wire::reason_from_close_code(code));
        std::string text(wire::reason_from_close_code(code));
        if (!expected_.empty() && text.size() + 2 + expected_.size() <= kMaxCloseReasonBytes) {
            text += "; " + expected_;
        }
        const websocket::close_reason reason(static_cast<websocket::close_code>(code), text);
        auto [error] = co_await socket_.async_close(reason, kNoThrow);
        static_cast<void>(error);
    }

    // A peer that does not read is first told so (4006, sent if it reads again in time); then
    // its connection is cut.
    void watch_write() {
        write_timer_.expires_after(services_.options.write_timeout);
        write_timer_.async_wait([self = shared_from_this()](const beast::error_code& error) {
            if (error) {
                return;
            }
            self->close(CloseCode::does_not_read);
            self->write_timer_.expires_after(self->services_.options.write_grace);
            self->write_timer_.async_wait([self](const beast::error_code& late) {
                if (!late) {
                    self->services_.metrics.count_close(CloseCode::does_not_read);
                    spdlog::info("viewer_cut room={} reason=\"does not read\"",
                                 self->room_ ? self->room_->name() : "-");
                    beast::get_lowest_layer(self->socket_).close();
                }
            });
        });
    }

    websocket::stream<beast::tcp_stream> socket_;
    const ConnectionServices& services_;
    const HttpRequest request_;
    const std::shared_ptr<Outbox> outbox_;
    std::shared_ptr<Room> room_;
    ViewerId viewer_{};  // in the room
    asio::steady_timer wake_timer_;
    asio::steady_timer write_timer_;
    asio::steady_timer done_waiting_{socket_.get_executor()};
    TokenBucket messages_;
    std::uint64_t errors_ = 0;
    bool reading_ = true;
    bool writing_ = true;
    bool closing_ = false;
    std::string expected_;  // more than the close code says
    bool fails_ = false;    // a close frame of our own is on its way, see fail_for_close_code
};

}  // namespace

asio::awaitable<void> serve_websocket(beast::tcp_stream stream,
                                      http::request<http::empty_body> upgrade,
                                      HttpRequest request,
                                      std::string room,
                                      const ConnectionServices& services) {
    auto connection =
        std::make_shared<WebSocketConnection>(std::move(stream), std::move(request), services);
    co_await connection->run(std::move(upgrade), std::move(room));
}

}  // namespace relume::net
