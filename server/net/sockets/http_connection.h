// HTTP/1.1 over one TCP connection, until it ends or becomes a WebSocket.
#pragma once

#include "server/net/sockets/connection_services.h"

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>

namespace relume::net {

// Serves requests one after another; runs on the socket's executor, a strand. Bodies are read
// for uploads only, and never with a Transfer-Encoding. Never throws for what a peer does.
[[nodiscard]] boost::asio::awaitable<void> serve_http(boost::asio::ip::tcp::socket socket,
                                                      const ConnectionServices& services);

}  // namespace relume::net
