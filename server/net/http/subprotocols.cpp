#include "server/net/http/subprotocols.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace relume::net {

namespace {

constexpr std::string_view kVersionPrefix = "relume.v";
constexpr std::string_view kTokenPrefix = "relume.token.";
constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

// The first offered protocol of which `is_sought` holds.
template <typename Predicate>
std::optional<std::string_view> find_offered(std::string_view offered,
                                             const Predicate& is_sought) {
    constexpr std::string_view kBlanks = " \t";
    while (!offered.empty()) {
        std::string_view protocol = offered.substr(0, offered.find(','));
        offered.remove_prefix(std::min(protocol.size() + 1, offered.size()));
        protocol.remove_prefix(std::min(protocol.find_first_not_of(kBlanks), protocol.size()));
        protocol = protocol.substr(0, protocol.find_last_not_of(kBlanks) + 1);
        if (is_sought(protocol)) {
            return protocol;
        }
    }
    return std::nullopt;
}

// What is offered, as it lies in the request.
std::string_view text_of(const std::optional<std::string>& offered) {
    return offered ? std::string_view(*offered) : std::string_view();
}

std::optional<std::string> bytes_from_base64url(std::string_view text) {
    std::string bytes;
    std::uint32_t bits = 0;
    unsigned count = 0;
    for (const char c : text) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) {
            return std::nullopt;
        }
        bits = bits << 6U | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<char>(bits >> count & 0xFFU));
        }
    }
    // What is left over belongs to no byte: fewer than six bits, all of them zero.
    const std::uint32_t rest = bits & ((1U << count) - 1U);
    return count < 6 && rest == 0 ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace

bool offers_subprotocol(const std::optional<std::string>& offered) {
    return find_offered(text_of(offered),
                        [](std::string_view protocol) { return protocol == kSubprotocol; })
        .has_value();
}

bool offers_other_versions_only(const std::optional<std::string>& offered) {
    const auto other = find_offered(text_of(offered), [](std::string_view protocol) {
        return protocol.starts_with(kVersionPrefix);
    });
    return other && !offers_subprotocol(offered);
}

std::optional<std::string> token_from_subprotocols(const std::optional<std::string>& offered) {
    const auto found = find_offered(text_of(offered), [](std::string_view protocol) {
        return protocol.starts_with(kTokenPrefix);
    });
    return found ? bytes_from_base64url(found->substr(kTokenPrefix.size())) : std::nullopt;
}

}  // namespace relume::net
