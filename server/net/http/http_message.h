// Requests and answers as the routes see them, free of any HTTP library.
#pragma once

#include "protocol/wire/errors.h"
#include "server/net/http/request_target.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relume::net {

enum class HttpMethod : std::uint8_t { get, head, post, options, other };

struct HttpRequest {
    HttpMethod method = HttpMethod::get;
    RequestTarget target;
    std::string host;
    std::optional<std::string> origin;
    std::optional<std::string> authorization;
    std::optional<std::string> if_none_match;
    std::optional<std::string> subprotocols;  // that a WebSocket client offers
    std::optional<std::uint64_t> content_length;
    std::string client;  // the quota_key of whose request it is
};

struct HttpReply {
    unsigned status = 200;
    std::string content_type;
    std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
    std::vector<std::pair<std::string, std::string>> headers;
};

[[nodiscard]] HttpReply text_reply(unsigned status, std::string text);
[[nodiscard]] HttpReply json_reply(unsigned status, std::string json);
// {"error":{…}} [protocol/README.md §3].
[[nodiscard]] HttpReply error_reply(unsigned status, const wire::WireError& error);

}  // namespace relume::net
