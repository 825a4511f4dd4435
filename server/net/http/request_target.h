// Path and query of a request line, from a peer that may mean harm.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace relume::net {

inline constexpr std::size_t kMaxTargetBytes = 2048;
inline constexpr std::size_t kMaxQueryParameters = 16;

struct RequestTarget {
    std::string path;  // begins with '/', decoded
    std::map<std::string, std::string, std::less<>> query;

    [[nodiscard]] std::optional<std::string> parameter(std::string_view name) const;
};

// Origin form only [RFC 9112 §3.2.1], percent-decoded; '+' in the query is a space. Nothing for
// what is longer than the bounds above, has a bad escape, a control character (escaped or not),
// a "." or ".." segment, a backslash, or the same parameter twice.
[[nodiscard]] std::optional<RequestTarget> parse_request_target(std::string_view target);

}  // namespace relume::net
