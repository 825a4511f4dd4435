#include "server/net/peers/origin_policy.h"

#include <algorithm>

namespace relume::net {

namespace {

bool is_same_origin(const Origin& origin, std::string_view host) {
    const std::optional<Authority> own = authority_from_text(host);
    return own && without_default_port(*own, origin.scheme) == origin.authority;
}

}  // namespace

OriginPolicy::OriginPolicy(const std::vector<std::string>& allowed) {
    for (const std::string& text : allowed) {
        allows_all_ = allows_all_ || text == "*";
        if (std::optional<Origin> origin = origin_from_text(text)) {
            allowed_.push_back(*std::move(origin));
        }
    }
}

bool OriginPolicy::allows(std::optional<std::string_view> origin, std::string_view host) const {
    if (!origin || allows_cross(origin, host)) {
        return true;
    }
    const std::optional<Origin> parsed = origin_from_text(*origin);
    return parsed && is_same_origin(*parsed, host);
}

bool OriginPolicy::allows_cross(std::optional<std::string_view> origin,
                                std::string_view host) const {
    if (!origin) {
        return false;
    }
    const std::optional<Origin> parsed = origin_from_text(*origin);
    if (parsed && is_same_origin(*parsed, host)) {
        return false;
    }
    return allows_all_ ||
           (parsed && std::find(allowed_.begin(), allowed_.end(), *parsed) != allowed_.end());
}

}  // namespace relume::net
