// Takes TCP connections on one address.
#pragma once

#include "server/net/peers/address_quota.h"
#include "server/net/sockets/connection_services.h"

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <atomic>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace relume::net {

// The address cannot be listened on; the message says which and why.
class ListenError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// HOST:PORT, [IPV6]:PORT. Throws ListenError.
[[nodiscard]] boost::asio::ip::tcp::endpoint endpoint_from_address(const std::string& address);

class Listener {
  public:
    // Binds and listens. Throws ListenError.
    Listener(boost::asio::io_context& io, const boost::asio::ip::tcp::endpoint& endpoint);

    // With the port that was taken.
    [[nodiscard]] const boost::asio::ip::tcp::endpoint& endpoint() const { return endpoint_; }
    // Begins to serve; returns at once.
    void start(const ConnectionServices& services);
    // Takes no more connections; from any thread.
    void stop();
    // Connections being served.
    [[nodiscard]] std::size_t connections() const { return connections_.load(); }

  private:
    [[nodiscard]] boost::asio::awaitable<void> accept_all(const ConnectionServices& services);
    // `place` is held as long as the connection is open.
    [[nodiscard]] boost::asio::awaitable<void> serve(boost::asio::ip::tcp::socket socket,
                                                     AddressQuota::Place place,
                                                     const ConnectionServices& services);

    boost::asio::io_context& io_;
    boost::asio::ip::tcp::acceptor acceptor_;  // on a strand of its own
    boost::asio::ip::tcp::endpoint endpoint_;
    std::atomic<std::size_t> connections_{0};
    std::optional<AddressQuota> by_address_;  // once started
};

}  // namespace relume::net
