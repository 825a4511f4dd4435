#include "server/net/http_connection.h"

#include "protocol/wire/names.h"
#include "server/net/websocket_connection.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>
#include <span>
#include <utility>

namespace relume::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

using wire::ErrorCode;
using wire::WireError;

namespace {

constexpr auto kNoThrow = asio::as_tuple(asio::use_awaitable);
constexpr std::size_t kReadBufferBytes = 64 * 1024;
// What is still read of a refused body, so that the refusal is not lost in a reset.
constexpr std::size_t kMaxDiscardedBytes = std::size_t{16} << 20;
constexpr std::chrono::seconds kDiscardTimeout{5};

using HeaderParser = http::request_parser<http::empty_body>;
using BodyParser = http::request_parser<http::vector_body<unsigned char>>;

std::optional<std::string> field(const HeaderParser& parser, http::field name) {
    const auto found = parser.get().find(name);
    return found == parser.get().end() ? std::nullopt
                                       : std::optional<std::string>(found->value());
}

HttpMethod method_from(http::verb verb) {
    switch (verb) {
        case http::verb::get:
            return HttpMethod::get;
        case http::verb::head:
            return HttpMethod::head;
        case http::verb::post:
            return HttpMethod::post;
        case http::verb::options:
            return HttpMethod::options;
        default:
            return HttpMethod::other;
    }
}

HttpReply bad_request(unsigned status,
                      ErrorCode code,
                      std::string found,
                      std::string expected) {
    return error_reply(status, WireError(code, "", std::move(found), std::move(expected)));
}

// What is wrong with a request whose header could not be read, if it is the peer's fault.
std::optional<HttpReply> reply_to_unreadable(const beast::error_code& error) {
    if (error == http::error::end_of_stream || error == http::error::partial_message ||
        error.category() != make_error_code(http::error::bad_method).category()) {
        return std::nullopt;
    }
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
        return bad_request(431, ErrorCode::too_large, "a larger request header",
                           "a request header within the limit");
    }
    if (error == http::error::body_limit) {
        return bad_request(413, ErrorCode::too_large, "a larger body",
                           "a body within the limit for uploads");
    }
    return bad_request(400, ErrorCode::unsupported, error.message(), "an HTTP/1.1 request");
}

class HttpConnection {
  public:
    HttpConnection(asio::ip::tcp::socket socket, const ConnectionServices& services)
        : stream_(std::move(socket)), services_(services), buffer_(kReadBufferBytes) {}

    asio::awaitable<void> run() {
        bool again = true;
        while (again) {
            again = co_await serve_one();
        }
    }

  private:
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
        std::optional<HttpReply> refusal = refuse(parser);
        if (refusal) {
            co_await send_last(*refusal, parser);
            co_return false;
        }
        HttpRequest request = request_from(parser);
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

    // What holds whatever is asked for. `target_` is set if nothing is wrong.
    std::optional<HttpReply> refuse(const HeaderParser& parser) {
        const auto& header = parser.get();
        if (header.find(http::field::transfer_encoding) != header.end()) {
            // Beast 1.81 does not bound chunk headers, and two lengths are one too many.
            return bad_request(501, ErrorCode::unsupported, "Transfer-Encoding",
                               "a body with Content-Length alone");
        }
        if (header.count(http::field::host) != 1 && header.version() >= 11) {
            return bad_request(400, ErrorCode::missing_field,
                               fmt::format("{} Host fields", header.count(http::field::host)),
                               "one Host field");
        }
        const beast::string_view target = header.target();
        target_ = parse_request_target({target.data(), target.size()});
        if (!target_) {
            return bad_request(400, ErrorCode::out_of_range, "a malformed request target",
                               "an absolute path and query");
        }
        return std::nullopt;
    }

    HttpRequest request_from(const HeaderParser& parser) {
        HttpRequest request{.method = method_from(parser.get().method()),
                            .target = *std::move(target_),
                            .host = field(parser, http::field::host).value_or(""),
                            .origin = field(parser, http::field::origin),
                            .authorization = field(parser, http::field::authorization),
                            .if_none_match = field(parser, http::field::if_none_match),
                            .content_length = {}};
        if (const auto length = parser.content_length()) {
            request.content_length = *length;
        }
        return request;
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
        if (!room || !wire::is_name(*room)) {
            refusal = bad_request(404, ErrorCode::not_found, request.target.path,
                                  fmt::format("/session/ROOM, ROOM being {}", wire::kNameRule));
        } else if (!services_.access.allows_origin(request)) {
            refusal = bad_request(403, ErrorCode::unsupported, *request.origin,
                                  "the server's own origin or an allowed one");
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
        stream_.expires_after(services_.options.body_timeout);
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
        auto [error, bytes] = co_await http::async_read(stream_, buffer_, body, kNoThrow);
        static_cast<void>(bytes);
        if (error) {
            co_return false;
        }
        stream_.expires_never();
        Uploads& uploads = services_.uploads;
        auto work = [&uploads, upload = std::get<Upload>(std::move(admitted)),
                     file = body.release().body()]() -> asio::awaitable<HttpReply> {
            co_return uploads.finish(upload, std::as_bytes(std::span(file)));
        };
        const HttpReply reply = co_await asio::co_spawn(services_.slow_requests,
                                                        std::move(work), asio::use_awaitable);
        HeaderParser answered;
        co_return co_await send(reply, answered, keep_alive);
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
    std::optional<RequestTarget> target_;
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
