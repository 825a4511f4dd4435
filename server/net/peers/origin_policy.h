// Which pages' scripts may enter rooms and upload.
#pragma once

#include "server/net/peers/authority.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// Immutable.
class OriginPolicy {
  public:
    // Besides the server's own origin; "*" stands for all. What is no origin allows nothing.
    explicit OriginPolicy(const std::vector<std::string>& allowed);

    // `origin` is the request's Origin header: no browser sent a request without one on behalf
    // of another page. `host` is its Host header. A scheme's default port is as good as none.
    [[nodiscard]] bool allows(std::optional<std::string_view> origin,
                              std::string_view host) const;
    // The origin is another than the server's own, and allowed: the answer must say so [CORS].
    [[nodiscard]] bool allows_cross(std::optional<std::string_view> origin,
                                    std::string_view host) const;

  private:
    std::vector<Origin> allowed_;
    bool allows_all_ = false;
};

}  // namespace relume::net
