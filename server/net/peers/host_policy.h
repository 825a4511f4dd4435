// Under which names the server may be asked. A page from elsewhere whose own name is made to
// point here (DNS rebinding) has the server's address, and for the browser its origin; only the
// Host field tells.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// Immutable.
class HostPolicy {
  public:
    // `listen` as it is configured, HOST:PORT, and the address it stands for. `allowed`:
    // further names or addresses, without ports; "*" stands for all.
    HostPolicy(std::string_view listen,
               boost::asio::ip::address address,
               const std::vector<std::string>& allowed);

    // `host` is the Host field. Whatever the port (which proxies and forwarded ports change):
    // the configured name; addresses of the loopback and "localhost", if the server listens
    // there; the very address, or any where it listens on all; and what is allowed.
    [[nodiscard]] bool allows(std::string_view host) const;

  private:
    [[nodiscard]] bool listens_as(const std::string& host) const;

    std::string listen_host_;
    boost::asio::ip::address address_;
    std::vector<std::string> allowed_;
    bool allows_all_ = false;
};

}  // namespace relume::net
