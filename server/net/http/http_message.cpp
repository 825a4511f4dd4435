#include "server/net/http/http_message.h"

#include "protocol/wire/messages.h"

namespace relume::net {

namespace {

HttpReply reply(unsigned status, std::string content_type, std::string body) {
    return {.status = status,
            .content_type = std::move(content_type),
            .body = std::make_shared<const std::string>(std::move(body)),
            .headers = {{"Cache-Control", "no-store"}}};
}

}  // namespace

HttpReply text_reply(unsigned status, std::string text) {
    return reply(status, "text/plain; charset=utf-8", std::move(text));
}

HttpReply json_reply(unsigned status, std::string json) {
    return reply(status, "application/json", std::move(json));
}

HttpReply error_reply(unsigned status, const wire::WireError& error) {
    return json_reply(status, wire::http_body_from_error(error));
}

}  // namespace relume::net
