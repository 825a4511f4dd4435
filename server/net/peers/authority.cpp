#include "server/net/peers/authority.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace relume::net {

namespace {

constexpr std::uint16_t kHttpPort = 80;
constexpr std::uint16_t kHttpsPort = 443;

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

bool is_of_a_host(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '_';
}

bool is_of_an_address(char c) {
    return std::isxdigit(static_cast<unsigned char>(c)) != 0 || c == ':' || c == '.';
}

}  // namespace

std::optional<Authority> authority_from_text(std::string_view text) {
    const bool bracketed = text.starts_with('[');
    const std::size_t host_end = bracketed ? text.find(']') : text.find(':');
    std::string_view host = text.substr(bracketed ? 1 : 0);
    host = host.substr(
        0, host_end == std::string_view::npos ? host_end : host_end - (bracketed ? 1 : 0));
    std::string_view rest =
        host_end == std::string_view::npos ? "" : text.substr(host_end + (bracketed ? 1 : 0));
    if (bracketed && host_end == std::string_view::npos) {
        return std::nullopt;
    }
    if (host.ends_with('.')) {
        host.remove_suffix(1);
    }
    if (host.empty() ||
        !std::all_of(host.begin(), host.end(), bracketed ? is_of_an_address : is_of_a_host)) {
        return std::nullopt;
    }
    Authority authority{.host = lower(host), .port = {}};
    if (!rest.empty()) {
        std::uint16_t port = 0;
        const auto [last, error] =
            std::from_chars(rest.data() + 1, rest.data() + rest.size(), port);
        if (rest.front() != ':' || error != std::errc() || last != rest.data() + rest.size()) {
            return std::nullopt;
        }
        authority.port = port;
    }
    return authority;
}

Authority without_default_port(Authority authority, std::string_view scheme) {
    if ((scheme == "http" && authority.port == kHttpPort) ||
        (scheme == "https" && authority.port == kHttpsPort)) {
        authority.port.reset();
    }
    return authority;
}

std::optional<Origin> origin_from_text(std::string_view text) {
    const std::size_t scheme_end = text.find("://");
    if (scheme_end == std::string_view::npos) {
        return std::nullopt;
    }
    std::string scheme = lower(text.substr(0, scheme_end));
    std::optional<Authority> authority = authority_from_text(text.substr(scheme_end + 3));
    if (!authority || (scheme != "http" && scheme != "https")) {
        return std::nullopt;
    }
    Authority place = without_default_port(*std::move(authority), scheme);
    return Origin{.scheme = std::move(scheme), .authority = std::move(place)};
}

}  // namespace relume::net
