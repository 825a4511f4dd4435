// Which pages' scripts may open sessions and upload.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// Immutable.
class OriginPolicy {
  public:
    // Besides the server's own origin; "*" stands for all.
    explicit OriginPolicy(std::vector<std::string> allowed) : allowed_(std::move(allowed)) {}

    // `origin` is the request's Origin header: no browser sent a request without one on behalf
    // of another page. `host` is its Host header.
    [[nodiscard]] bool allows(std::optional<std::string_view> origin,
                              std::string_view host) const;
    // The origin is another than the server's own, and allowed: the answer must say so [CORS].
    [[nodiscard]] bool allows_cross(std::optional<std::string_view> origin,
                                    std::string_view host) const;

  private:
    std::vector<std::string> allowed_;
};

}  // namespace relume::net
