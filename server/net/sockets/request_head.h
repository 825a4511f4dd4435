// The head of a request as Beast has parsed it: what it asks for, and what is wrong with it.
#pragma once

#include "server/net/http/http_message.h"

#include <boost/beast/core/error.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>

#include <optional>
#include <string>
#include <variant>

namespace relume::net {

using HeaderParser = boost::beast::http::request_parser<boost::beast::http::empty_body>;

// The first field of that name.
[[nodiscard]] std::optional<std::string> field(const HeaderParser& parser,
                                               boost::beast::http::field name);
// All X-Forwarded-For fields as one list [RFC 9110 §5.3].
[[nodiscard]] std::string forwarded_for(const HeaderParser& parser);

[[nodiscard]] HttpReply bad_request(unsigned status,
                                    wire::ErrorCode code,
                                    std::string found,
                                    std::string expected);
// To a head that could not be read, if that is the peer's fault.
[[nodiscard]] std::optional<HttpReply> reply_to_unreadable(
    const boost::beast::error_code& error);

// The request, but for whose it is; or the refusal of what is wrong whatever is asked for.
[[nodiscard]] std::variant<HttpRequest, HttpReply> request_from_head(
    const HeaderParser& parser);
// What of an upgrade is against RFC 6455 §4.2.1.
[[nodiscard]] std::optional<HttpReply> fault_of_handshake(const HeaderParser& parser);

}  // namespace relume::net
