#include "server/net/peers/plain_address.h"

namespace relume::net {

namespace ip = boost::asio::ip;

ip::address plain_address(const ip::address& address) {
    return address.is_v6() && address.to_v6().is_v4_mapped()
               ? ip::make_address_v4(ip::v4_mapped, address.to_v6())
               : address;
}

}  // namespace relume::net
