#include "server/net/origin_policy.h"

#include <algorithm>
#include <cctype>

namespace relume::net {

namespace {

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    });
}

bool is_same_origin(std::string_view origin, std::string_view host) {
    const std::size_t scheme_end = origin.find("://");
    return scheme_end != std::string_view::npos && !host.empty() &&
           equal_ignoring_case(origin.substr(scheme_end + 3), host);
}

}  // namespace

bool OriginPolicy::allows(std::optional<std::string_view> origin, std::string_view host) const {
    return !origin || is_same_origin(*origin, host) || allows_cross(origin, host);
}

bool OriginPolicy::allows_cross(std::optional<std::string_view> origin,
                                std::string_view host) const {
    if (!origin || is_same_origin(*origin, host)) {
        return false;
    }
    return std::any_of(allowed_.begin(), allowed_.end(), [&](const std::string& allowed) {
        return allowed == "*" || equal_ignoring_case(allowed, *origin);
    });
}

}  // namespace relume::net
