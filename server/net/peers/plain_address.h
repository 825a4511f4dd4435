// One form for each address.
#pragma once

#include <boost/asio/ip/address.hpp>

namespace relume::net {

// An IPv4 address that is mapped into IPv6 (::ffff:…) as IPv4; any other as it is.
[[nodiscard]] boost::asio::ip::address plain_address(const boost::asio::ip::address& address);

}  // namespace relume::net
