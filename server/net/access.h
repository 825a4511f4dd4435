// Who may open sessions and upload: the token, and the pages a browser may come from.
#pragma once

#include "server/net/http_message.h"
#include "server/net/origin_policy.h"

#include <string>
#include <string_view>

namespace relume::net {

// Immutable.
class Access {
  public:
    // An empty token asks for none.
    Access(std::string token, OriginPolicy origins)
        : token_(std::move(token)), origins_(std::move(origins)) {}

    // `token=` in the query, or `Authorization: Bearer`.
    [[nodiscard]] bool has_token(const HttpRequest& request) const;
    [[nodiscard]] bool allows_origin(const HttpRequest& request) const {
        return origins_.allows(request.origin, request.host);
    }
    // The page's script may read the answer only if it names its origin [CORS].
    [[nodiscard]] bool must_name_origin(const HttpRequest& request) const {
        return origins_.allows_cross(request.origin, request.host);
    }

  private:
    std::string token_;
    OriginPolicy origins_;
};

}  // namespace relume::net
