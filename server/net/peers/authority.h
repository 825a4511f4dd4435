// Host and port as the Host and Origin fields of a request name them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace relume::net {

// Two are the same place if they are equal.
struct Authority {
    std::string host;  // lower case, without brackets and without the root's dot
    std::optional<std::uint16_t> port;

    friend bool operator==(const Authority&, const Authority&) = default;
};

// HOST, HOST:PORT, [IPV6] or [IPV6]:PORT; nothing if it is none of these.
[[nodiscard]] std::optional<Authority> authority_from_text(std::string_view text);

// Scheme and place of an origin, http://HOST[:PORT]; the port a scheme has anyway is none.
struct Origin {
    std::string scheme;  // lower case
    Authority authority;

    friend bool operator==(const Origin&, const Origin&) = default;
};
// Nothing for "null" and whatever is no http or https origin.
[[nodiscard]] std::optional<Origin> origin_from_text(std::string_view text);

// The authority as it would stand in an origin of this scheme: its default port is none.
[[nodiscard]] Authority without_default_port(Authority authority, std::string_view scheme);

}  // namespace relume::net
