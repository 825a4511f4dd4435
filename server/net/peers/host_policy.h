// The names under which the server answers. A page from elsewhere can make its own name point
// here (DNS rebinding). It then has, for the browser, the server's origin; only the Host field
// tells the two apart.
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
