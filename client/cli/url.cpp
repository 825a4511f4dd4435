#include "client/cli/url.h"

#include "protocol/base/program/usage.h"

#include <fmt/format.h>

#include <charconv>

namespace relume::cli {
namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
    throw program::UsageError(
        fmt::format("server URL \"{}\": found {}, expected HOST[:PORT], http://HOST[:PORT] or "
                    "ws://HOST[:PORT]",
                    text, why));
}

bool is_port(std::string_view text) {
    unsigned port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    return error == std::errc{} && end == text.data() + text.size() && port >= 1 &&
           port <= 65535;
}

}  // namespace

std::string Url::authority() const {
    const std::string name = host.find(':') == std::string::npos ? host : '[' + host + ']';
    return port == "80" ? name : name + ':' + port;
}

Url url_from_text(std::string_view text) {
    std::string_view rest = text;
    for (const std::string_view scheme : {"http://", "ws://"}) {
        if (rest.starts_with(scheme)) {
            rest.remove_prefix(scheme.size());
            break;
        }
    }
    if (rest.find("://") != std::string_view::npos) {
        refuse(text, "another scheme");
    }
    if (rest.find_first_of("?#@ ") != std::string_view::npos) {
        refuse(text, "a user, query, fragment or space");
    }
    Url url;
    if (const std::size_t slash = rest.find('/'); slash != std::string_view::npos) {
        url.prefix = rest.substr(slash);
        rest = rest.substr(0, slash);
        while (url.prefix.ends_with('/')) {
            url.prefix.pop_back();
        }
    }
    std::string_view port;
    if (rest.starts_with('[')) {
        const std::size_t bracket = rest.find(']');
        if (bracket == std::string_view::npos) {
            refuse(text, "an IPv6 address without its closing bracket");
        }
        url.host = rest.substr(1, bracket - 1);
        rest.remove_prefix(bracket + 1);
        if (!rest.empty() && rest.front() != ':') {
            refuse(text, "characters after the address");
        }
        port = rest;
    } else {
        const std::size_t colon = rest.find(':');
        url.host = rest.substr(0, colon);
        port = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon);
    }
    if (url.host.empty()) {
        refuse(text, "no host");
    }
    if (!port.empty()) {
        port.remove_prefix(1);
        if (!is_port(port)) {
            refuse(text, "a port that is not 1 … 65535");
        }
        url.port = port;
    }
    return url;
}

std::string percent_encoded(std::string_view text) {
    std::string encoded;
    for (const char c : text) {
        const bool unreserved = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                                (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' ||
                                c == '~';
        if (unreserved) {
            encoded += c;
        } else {
            encoded += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return encoded;
}

}  // namespace relume::cli
