#include "server/net/sockets/request_head.h"

#include <boost/beast/http/error.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace relume::net {

namespace beast = boost::beast;
namespace http = beast::http;

using wire::ErrorCode;
using wire::WireError;

namespace {

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

// Base64 of 16 bytes [RFC 6455 §4.1].
bool is_websocket_key(beast::string_view key) {
    constexpr std::size_t kDigits = 22;
    return key.size() == kDigits + 2 && key.ends_with("==") &&
           std::all_of(key.begin(), key.begin() + kDigits, [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '+' || c == '/';
           });
}

}  // namespace

std::optional<std::string> field(const HeaderParser& parser, http::field name) {
    const auto found = parser.get().find(name);
    return found == parser.get().end() ? std::nullopt
                                       : std::optional<std::string>(found->value());
}

std::string forwarded_for(const HeaderParser& parser) {
    std::string list;
    const auto [first, last] = parser.get().equal_range("X-Forwarded-For");
    for (auto it = first; it != last; ++it) {
        list.append(list.empty() ? "" : ",").append(it->value());
    }
    return list;
}

HttpReply bad_request(unsigned status,
                      ErrorCode code,
                      std::string found,
                      std::string expected) {
    return error_reply(status, WireError(code, "", std::move(found), std::move(expected)));
}

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

// Beast 1.81 looks at neither number nor length.
std::optional<HttpReply> fault_of_handshake(const HeaderParser& parser) {
    const auto& header = parser.get();
    const auto only = [&header](http::field name) {
        return header.count(name) == 1 ? header.find(name)->value() : beast::string_view();
    };
    if (only(http::field::sec_websocket_version) != "13") {
        HttpReply reply =
            bad_request(426, ErrorCode::unsupported, "another or no Sec-WebSocket-Version",
                        "Sec-WebSocket-Version: 13, once");
        reply.headers.emplace_back("Sec-WebSocket-Version", "13");
        return reply;
    }
    if (!is_websocket_key(only(http::field::sec_websocket_key))) {
        return bad_request(400, ErrorCode::unsupported,
                           fmt::format("{} Sec-WebSocket-Key fields, or one that is no key",
                                       header.count(http::field::sec_websocket_key)),
                           "one Sec-WebSocket-Key, base64 of 16 bytes");
    }
    return std::nullopt;
}

std::variant<HttpRequest, HttpReply> request_from_head(const HeaderParser& parser) {
    const auto& header = parser.get();
    if (header.find(http::field::transfer_encoding) != header.end()) {
        // Beast 1.81 does not bound chunk headers, and two lengths are one too many.
        return bad_request(501, ErrorCode::unsupported, "Transfer-Encoding",
                           "a body with Content-Length alone");
    }
    const std::size_t hosts = header.count(http::field::host);
    if (hosts > 1 || (hosts == 0 && header.version() >= 11)) {
        return bad_request(400, ErrorCode::missing_field, fmt::format("{} Host fields", hosts),
                           "one Host field");
    }
    const beast::string_view target = header.target();
    std::optional<RequestTarget> parsed = parse_request_target({target.data(), target.size()});
    if (!parsed) {
        return bad_request(400, ErrorCode::out_of_range, "a malformed request target",
                           "an absolute path and query");
    }
    HttpRequest request{.method = method_from(header.method()),
                        .target = *std::move(parsed),
                        .host = field(parser, http::field::host).value_or(""),
                        .origin = field(parser, http::field::origin),
                        .authorization = field(parser, http::field::authorization),
                        .if_none_match = field(parser, http::field::if_none_match),
                        .subprotocols = field(parser, http::field::sec_websocket_protocol),
                        .content_length = {},
                        .client = {}};
    if (const auto length = parser.content_length()) {
        request.content_length = *length;
    }
    return request;
}

}  // namespace relume::net
