// What a request may do: by its token, the page that a browser made it for, and the name
// under which it asks for the server.
#pragma once

#include "server/net/http/http_message.h"
#include "server/net/peers/host_policy.h"
#include "server/net/peers/origin_policy.h"
#include "server/net/peers/role.h"

#include <string>
#include <string_view>

namespace relume::net {

// Immutable.
class Access {
  public:
    // An empty token asks for none.
    Access(std::string token, OriginPolicy origins, HostPolicy hosts)
        : token_(std::move(token)), origins_(std::move(origins)), hosts_(std::move(hosts)) {}

    // `editor` for a request with the server's token, or for any request where the server asks
    // for none. The token comes as `Authorization: Bearer`, among the subprotocols, or as
    // `token=` in the query; the first of these that is there counts.
    [[nodiscard]] Role role_of(const HttpRequest& request) const;
    // Whether the server answers under this name, whatever is asked for.
    [[nodiscard]] bool allows_host(std::string_view host) const { return hosts_.allows(host); }
    [[nodiscard]] bool allows_origin(const HttpRequest& request) const {
        return origins_.allows(request.origin, request.host);
    }
    // The page's script may read the answer only if it names its origin [CORS].
    [[nodiscard]] bool must_name_origin(const HttpRequest& request) const {
        return origins_.allows_cross(request.origin, request.host);
    }

  private:
    [[nodiscard]] bool has_token(const HttpRequest& request) const;

    std::string token_;
    OriginPolicy origins_;
    HostPolicy hosts_;
};

}  // namespace relume::net
