// One client of a room: edits and acknowledgements in, changes and images out.
#pragma once

#include "server/net/sockets/connection_services.h"

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include <string>

namespace relume::net {

// Answers the upgrade, serves the viewer and closes the connection. `upgrade` is the request as
// received, `request` the same as the routes see it, `room` a valid name. Never throws for what
// a peer does.
[[nodiscard]] boost::asio::awaitable<void> serve_websocket(
    boost::beast::tcp_stream stream,
    boost::beast::http::request<boost::beast::http::empty_body> upgrade,
    HttpRequest request,
    std::string room,
    const ConnectionServices& services);

}  // namespace relume::net
