// What a client offers in `Sec-WebSocket-Protocol` (protocol/README.md §3): versions of the
// protocol, and, where no other header can be set, the token.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace relume::net {

// The version of the protocol that this server speaks.
inline constexpr std::string_view kSubprotocol = "relume.v1";

// `offered` is the value of the field, several being separated by commas.
[[nodiscard]] bool offers_subprotocol(const std::optional<std::string>& offered);
[[nodiscard]] bool offers_other_versions_only(const std::optional<std::string>& offered);
// What `relume.token.TEXT` says, TEXT being base64url [RFC 4648 §5] without padding. Nothing
// where it is not offered, or not base64url.
[[nodiscard]] std::optional<std::string> token_from_subprotocols(
    const std::optional<std::string>& offered);

}  // namespace relume::net
