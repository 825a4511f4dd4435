#include "server/net/sockets/http_connection.h"

#include "protocol/base/text/names.h"
#include "server/net/http/query_rules.h"
#include "server/net/sockets/request_head.h"
#include "server/net/sockets/websocket_connection.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>

namespace relume::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

using asio::experimental::awaitable_operators::operator||;
using wire::ErrorCode;
using wire::WireError;

namespace {

constexpr auto kNoThrow = asio::as_tuple(asio::use_awaitable);
constexpr std::size_t kReadBufferBytes = 64 * 1024;
// What is still read of a refused body, so that the refusal is not lost in a reset.
constexpr std::size_t kMaxDiscardedBytes = std::size_t{16} << 20;
constexpr std::chrono::seconds kDiscardTimeout{5};

// Scripts are the page's own files. Its controls (tweakpane) bring a style sheet of their own,
// which is an element made by script. Images and connections may be of another server, which
// the page takes by `?server=`.
constexpr const char* kContentSecurityPolicy =
    "default-src 'none'; script-src 'self'; worker-src 'self'; style-src 'self' "
    "'unsafe-inline'; "
    "font-src 'self'; manifest-src 'self'; img-src 'self' data: blob: http: https:; "
    "connect-src 'self' http: https: ws: wss:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

using BodyParser = http::request_parser<http::vector_body<unsigned char>>;

class HttpConnection {
  public:
    HttpConnection(asio::ip::tcp::socket socket, const ConnectionServices& services)
        : stream_(std::move(socket)), services_(services), buffer_(kReadBufferBytes) {
        beast::error_code gone;
        peer_ = stream_.socket().remote_endpoint(gone).address();
    }

    asio::awaitable<void> run() {
        while (co_await request_begins()) {
            const bool again = co_await serve_one();
            if (!again) {
                break;
            }
        }
    }

  private:
    // False when none came in time, or the server drains: nobody waits for an answer then.
    asio::awaitable<bool> request_begins() {
        if (buffer_.size() != 0) {
            co_return true;
        }
        const auto executor = stream_.get_executor();
        // Outlives the connection in a callback that comes late.
        const auto patience =
            std::make_shared<asio::steady_timer>(executor, services_.options.request_timeout);
        const std::stop_callback on_drain(services_.readiness.draining(), [executor, patience] {
            asio::post(executor, [patience] { patience->cancel(); });
        });
        const auto first =
            co_await (stream_.socket().async_wait(asio::socket_base::wait_read, kNoThrow) ||
                      patience->async_wait(kNoThrow));
        co_return first.index() == 0;
    }

    // False when the connection is done, or no longer this one's.
    asio::awaitable<bool> serve_one() {
        HeaderParser parser;
        parser.header_limit(services_.options.request_header_bytes);
        parser.body_limit(services_.limits.upload_bytes);
        stream_.expires_after(services_.options.request_timeout);
        auto [error, bytes] =
            co_await http::async_read_header(stream_, buffer_, parser, kNoThrow);
        static_cast<void>(bytes);
        if (error) {
            const std::optional<HttpReply> reply = reply_to_unreadable(error);
            if (reply) {
                co_await send_last(*reply, parser);
            }
            co_return false;
        }
        std::variant<HttpRequest, HttpReply> head = request_of(parser);
        if (const HttpReply* const refusal = std::get_if<HttpReply>(&head)) {
            co_await send_last(*refusal, parser);
            co_return false;
        }
        HttpRequest request = std::get<HttpRequest>(std::move(head));
        origin_ = services_.access.must_name_origin(request) ? request.origin : std::nullopt;
        if (beast::websocket::is_upgrade(parser.get())) {
            co_return co_await upgrade(parser, std::move(request));
        }
        if (HttpRoutes::is_upload(request)) {
            co_return co_await take_upload(parser, std::move(request));
        }
        if (request.content_length.value_or(0) > 0) {
            const HttpReply reply = bad_request(400, ErrorCode::unsupported, "a request body",
                                                "no body but for uploads");
            co_await send_last(reply, parser);
            co_return false;
        }
        const bool keep_alive = parser.get().keep_alive() &&
                                services_.readiness.phase() != Readiness::Phase::draining;
        const HttpReply reply = co_await answer(std::move(request));
        co_return co_await send(reply, parser, keep_alive);
    }

    std::variant<HttpRequest, HttpReply> request_of(const HeaderParser& parser) const {
        std::variant<HttpRequest, HttpReply> head = request_from_head(parser);
        if (HttpRequest* const request = std::get_if<HttpRequest>(&head)) {
            // Without a Host field no browser has asked.
            if (parser.get().count(http::field::host) != 0 &&
                !services_.access.allows_host(request->host)) {
                return bad_request(421, ErrorCode::unsupported,
                                   fmt::format("Host {}", request->host),
                                   "the address listened on, or a name allowed by "
                                   "--allow-host");
            }
            request->client =
                quota_key(services_.proxies.client_of(peer_, forwarded_for(parser)));
        }
        return head;
    }

    asio::awaitable<HttpReply> answer(HttpRequest request) {
        if (!HttpRoutes::takes_long(request)) {
            co_return services_.routes.answer(request);
        }
        stream_.expires_never();
        const HttpRoutes& routes = services_.routes;
        auto work = [&routes, request = std::move(request)]() -> asio::awaitable<HttpReply> {
            co_return routes.answer(request);
        };
        co_return co_await asio::co_spawn(services_.slow_requests, std::move(work),
                                          asio::use_awaitable);
    }

    asio::awaitable<bool> upgrade(HeaderParser& parser, HttpRequest request) {
        const std::optional<std::string> room = HttpRoutes::room_of(request);
        std::optional<HttpReply> refusal;
        if (!room || !text::is_name(*room)) {
            refusal = bad_request(404, ErrorCode::not_found, request.target.path,
                                  fmt::format("/session/ROOM, ROOM being {}", text::kNameRule));
        } else if (!services_.access.allows_origin(request)) {
            refusal = bad_request(403, ErrorCode::unsupported, *request.origin,
                                  "the server's own origin or an allowed one");
        } else if (std::optional<HttpReply> fault = fault_of_handshake(parser)) {
            refusal = std::move(fault);
        } else if (std::optional<HttpReply> unfit = fault_of_session_request(request)) {
            refusal = std::move(unfit);
        } else if (!services_.readiness.ready()) {
            refusal =
                bad_request(503, ErrorCode::shutting_down, "a server starting or draining",
                            "this request again in a moment");
        } else if (buffer_.size() != 0) {
            refusal =
                bad_request(400, ErrorCode::unsupported, "bytes after the upgrade request",
                            "frames only after the answer");
        }
        if (refusal) {
            co_await send_last(*refusal, parser);
            co_return false;
        }
        services_.metrics.count_request(101);
        co_await serve_websocket(std::move(stream_), parser.release(), std::move(request),
                                 *room, services_);
        co_return false;
    }

    asio::awaitable<bool> take_upload(HeaderParser& parser, HttpRequest request) {
        std::variant<HttpReply, Upload> admitted = services_.uploads.admit(request);
        if (const HttpReply* const refusal = std::get_if<HttpReply>(&admitted)) {
            co_await send_last(*refusal, parser);
            co_return false;
        }
        const bool keep_alive = parser.get().keep_alive();
        const std::optional<std::string> expect = field(parser, http::field::expect);
        stream_.expires_after(services_.options.body_grace);
        if (expect && beast::iequals(*expect, "100-continue")) {
            http::response<http::empty_body> go_on(http::status::continue_, 11);
            auto [error, bytes] = co_await http::async_write(stream_, go_on, kNoThrow);
            static_cast<void>(bytes);
            if (error) {
                co_return false;
            }
        }
        // Reserves what the peer announced, which admission and the parser have bounded.
        BodyParser body(std::move(parser));
        if (!co_await read_body(body)) {
            co_return false;
        }
        stream_.expires_never();
        Uploads& uploads = services_.uploads;
        std::stop_source stop;
        auto work = [&uploads, upload = std::get<Upload>(std::move(admitted)),
                     file = body.release().body(),
                     token = stop.get_token()]() -> asio::awaitable<HttpReply> {
            co_return uploads.finish(upload, std::as_bytes(std::span(file)), token);
        };
        const auto done = co_await (
            asio::co_spawn(services_.slow_requests, std::move(work), asio::use_awaitable) ||
            stop_when_the_client_ends(stop));
        HeaderParser answered;
        co_return co_await send(std::get<0>(done), answered, keep_alive);
    }

    // Never returns; is cancelled when the answer is there. One who has ended its side waits
    // for no answer. What comes before the end belongs to the next request; of one who sends
    // more than the buffer takes the end is not seen.
    asio::awaitable<void> stop_when_the_client_ends(std::stop_source& stop) {
        beast::error_code ended;
        while (!ended && buffer_.size() < buffer_.max_size()) {
            auto [error, bytes] = co_await stream_.async_read_some(
                buffer_.prepare(buffer_.max_size() - buffer_.size()), kNoThrow);
            buffer_.commit(bytes);
            ended = error;
        }
        if (ended) {
            stop.request_stop();
        }
        asio::steady_timer forever(stream_.get_executor(), Clock::time_point::max());
        co_await forever.async_wait(kNoThrow);
    }

    // False when the connection has ended, or the bytes came too slowly.
    asio::awaitable<bool> read_body(BodyParser& body) {
        const ConnectionOptions& options = services_.options;
        const Clock::time_point begin = Clock::now();
        std::uint64_t received = 0;
        while (!body.is_done()) {
            const auto earned = std::chrono::milliseconds(received * std::milli::den /
                                                          options.body_bytes_per_second);
            stream_.expires_at(begin +
                               std::min(options.body_timeout, options.body_grace + earned));
            auto [error, bytes] =
                co_await http::async_read_some(stream_, buffer_, body, kNoThrow);
            if (error) {
                co_return false;
            }
            received += bytes;
        }
        co_return true;
    }

    // True if another request may follow.
    asio::awaitable<bool> send(const HttpReply& reply,
                               const HeaderParser& parser,
                               bool keep_alive) {
        services_.metrics.count_request(reply.status);
        http::response<http::span_body<const char>> message;
        message.result(reply.status);
        message.version(11);
        message.keep_alive(keep_alive);
        for (const auto& [name, value] : reply.headers) {
            message.set(name, value);
        }
        if (!reply.content_type.empty()) {
            message.set(http::field::content_type, reply.content_type);
        }
        message.set("X-Content-Type-Options", "nosniff");
        message.set("Referrer-Policy", "no-referrer");
        message.set("Content-Security-Policy", kContentSecurityPolicy);
        message.set("X-Frame-Options", "DENY");
        message.set(http::field::vary, "Origin");
        if (origin_) {
            message.set(http::field::access_control_allow_origin, *origin_);
        }
        const bool bodiless = reply.status == 204 || reply.status == 304;
        if (!bodiless) {
            message.content_length(reply.body->size());
        }
        if (parser.get().method() != http::verb::head && !bodiless) {
            message.body() = {reply.body->data(), reply.body->size()};
        }
        stream_.expires_after(services_.options.write_timeout);
        http::response_serializer<http::span_body<const char>> serializer(message);
        auto [error, bytes] = co_await http::async_write(stream_, serializer, kNoThrow);
        static_cast<void>(bytes);
        co_return !error && keep_alive;
    }

    asio::awaitable<void> send_last(const HttpReply& reply, const HeaderParser& parser) {
        co_await send(reply, parser, false);
        beast::error_code ignored;
        stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
        stream_.expires_after(kDiscardTimeout);
        std::array<char, 4096> discarded{};
        for (std::size_t total = 0; total < kMaxDiscardedBytes;) {
            auto [error, bytes] =
                co_await stream_.async_read_some(asio::buffer(discarded), kNoThrow);
            if (error) {
                break;
            }
            total += bytes;
        }
    }

    beast::tcp_stream stream_;
    const ConnectionServices& services_;
    beast::flat_buffer buffer_;
    asio::ip::address peer_;
    std::optional<std::string> origin_;  // to name in the answer
};

}  // namespace

asio::awaitable<void> serve_http(asio::ip::tcp::socket socket,
                                 const ConnectionServices& services) {
    services.metrics.add_connections(1);
    try {
        HttpConnection connection(std::move(socket), services);
        co_await connection.run();
    } catch (const std::exception& failure) {
        spdlog::error("connection_failed reason={:?}", failure.what());
    }
    services.metrics.add_connections(-1);
}

}  // namespace relume::net
