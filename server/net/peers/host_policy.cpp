#include "server/net/peers/host_policy.h"

#include "server/net/peers/authority.h"
#include "server/net/peers/plain_address.h"

#include <algorithm>
#include <utility>

namespace relume::net {

namespace ip = boost::asio::ip;

HostPolicy::HostPolicy(std::string_view listen,
                       ip::address address,
                       const std::vector<std::string>& allowed)
    : address_(plain_address(address)) {
    if (const auto authority = authority_from_text(listen)) {
        listen_host_ = authority->host;
    }
    for (const std::string& name : allowed) {
        allows_all_ = allows_all_ || name == "*";
        // An IPv6 address may come without its brackets.
        auto authority = authority_from_text(name);
        if (!authority) {
            authority = authority_from_text("[" + name + "]");
        }
        if (authority) {
            allowed_.push_back(std::move(authority->host));
        }
    }
}

bool HostPolicy::allows(std::string_view host) const {
    if (allows_all_) {
        return true;
    }
    const std::optional<Authority> authority = authority_from_text(host);
    return authority &&
           (listens_as(authority->host) ||
            std::find(allowed_.begin(), allowed_.end(), authority->host) != allowed_.end());
}

bool HostPolicy::listens_as(const std::string& host) const {
    const bool on_loopback = address_.is_loopback() || address_.is_unspecified();
    if (host == listen_host_) {
        return true;
    }
    if (host == "localhost" || host.ends_with(".localhost")) {
        return on_loopback;
    }
    boost::system::error_code error;
    const ip::address named = plain_address(ip::make_address(host, error));
    if (error) {
        return false;
    }
    return named == address_ || address_.is_unspecified() ||
           (address_.is_loopback() && named.is_loopback());
}

}  // namespace relume::net
