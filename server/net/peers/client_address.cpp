#include "server/net/peers/client_address.h"

#include "server/net/peers/plain_address.h"

#include <algorithm>
#include <stdexcept>

namespace relume::net {

namespace ip = boost::asio::ip;

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t";
    const std::size_t first = text.find_first_not_of(kSpace);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

}  // namespace

std::string quota_key(const ip::address& address) {
    const ip::address own = plain_address(address);
    if (own.is_v4()) {
        return own.to_string();
    }
    ip::address_v6::bytes_type bytes = own.to_v6().to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
    return ip::address_v6(bytes).to_string() + "/64";
}

TrustedProxies::TrustedProxies(const std::vector<std::string>& addresses) {
    for (const std::string& text : addresses) {
        boost::system::error_code error;
        addresses_.push_back(plain_address(ip::make_address(text, error)));
        if (error) {
            throw std::runtime_error("--trusted-proxy: found \"" + text +
                                     "\", expected an IPv4 or IPv6 address");
        }
    }
}

bool TrustedProxies::trusts(const ip::address& peer) const {
    return std::find(addresses_.begin(), addresses_.end(), plain_address(peer)) !=
           addresses_.end();
}

ip::address TrustedProxies::client_of(const ip::address& peer,
                                      std::string_view forwarded_for) const {
    ip::address client = plain_address(peer);
    while (trusts(client) && !forwarded_for.empty()) {
        const std::size_t comma = forwarded_for.rfind(',');
        const std::string_view last =
            trimmed(forwarded_for.substr(comma == std::string_view::npos ? 0 : comma + 1));
        forwarded_for = forwarded_for.substr(0, comma == std::string_view::npos ? 0 : comma);
        boost::system::error_code error;
        const ip::address named = ip::make_address(std::string(last), error);
        if (error) {
            break;
        }
        client = plain_address(named);
    }
    return client;
}

}  // namespace relume::net
