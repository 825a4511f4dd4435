// Which query parameters a request may carry (protocol/README.md §3).
#pragma once

#include "server/net/http/http_message.h"

#include <initializer_list>
#include <optional>
#include <string_view>

namespace relume::net {

// A refusal (400, unknown_field) naming a parameter that is not among `known`, and those that
// are.
[[nodiscard]] std::optional<HttpReply> fault_of_query(
    const RequestTarget& target, std::initializer_list<std::string_view> known);

// Of a request to enter a room: every parameter known, `images` one of its words, and a version
// of the protocol among those the client offers, if it offers any.
[[nodiscard]] std::optional<HttpReply> fault_of_session_request(const HttpRequest& request);

}  // namespace relume::net
