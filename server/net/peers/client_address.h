// Whose request it is: the address that quotas are kept by.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// An IPv4 address as it is; of an IPv6 address the first 64 bits, for whoever has one has all
// of them.
[[nodiscard]] std::string quota_key(const boost::asio::ip::address& address);

// Addresses whose X-Forwarded-For is believed, because they are proxies of our own.
class TrustedProxies {
  public:
    TrustedProxies() = default;
    // Throws std::runtime_error naming what is no address.
    explicit TrustedProxies(const std::vector<std::string>& addresses);

    [[nodiscard]] bool trusts(const boost::asio::ip::address& peer) const;
    // Of a request that came from `peer` with these X-Forwarded-For values, joined by commas:
    // the last address in it that no trusted proxy has, for each proxy appends who asked it and
    // what stands before may be made up. The peer's own if it is not trusted, or the field is
    // missing or no list of addresses.
    [[nodiscard]] boost::asio::ip::address client_of(const boost::asio::ip::address& peer,
                                                     std::string_view forwarded_for) const;

  private:
    std::vector<boost::asio::ip::address> addresses_;
};

}  // namespace relume::net
