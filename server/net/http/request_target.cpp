#include "server/net/http/request_target.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace relume::net {

namespace {

bool is_control(char c) {
    const auto value = static_cast<unsigned char>(c);
    return value < 0x20 || value == 0x7F;
}

std::optional<std::string> percent_decode(std::string_view text, bool plus_is_space) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            unsigned value = 0;
            if (text.size() - i < 3) {
                return std::nullopt;
            }
            const char* const digits = text.data() + i + 1;
            const auto [end, error] = std::from_chars(digits, digits + 2, value, 16);
            if (error != std::errc() || end != digits + 2) {
                return std::nullopt;
            }
            c = static_cast<char>(value);
            i += 2;
        } else if (c == '+' && plus_is_space) {
            c = ' ';
        }
        if (is_control(c)) {
            return std::nullopt;
        }
        decoded.push_back(c);
    }
    return decoded;
}

bool has_dot_segment(std::string_view path) {
    while (!path.empty()) {
        path.remove_prefix(1);  // '/'
        const std::string_view segment = path.substr(0, path.find('/'));
        if (segment == "." || segment == "..") {
            return true;
        }
        path.remove_prefix(segment.size());
    }
    return false;
}

}  // namespace

std::optional<std::string> RequestTarget::parameter(std::string_view name) const {
    const auto found = query.find(name);
    return found == query.end() ? std::nullopt : std::optional(found->second);
}

std::optional<RequestTarget> parse_request_target(std::string_view target) {
    if (target.empty() || target.front() != '/' || target.size() > kMaxTargetBytes) {
        return std::nullopt;
    }
    const std::size_t mark = target.find('?');
    std::optional<std::string> path = percent_decode(target.substr(0, mark), false);
    if (!path || path->find('\\') != std::string::npos || has_dot_segment(*path)) {
        return std::nullopt;
    }
    RequestTarget parsed{.path = *std::move(path), .query = {}};
    std::string_view rest = mark == std::string_view::npos ? "" : target.substr(mark + 1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
        const std::size_t equals = pair.find('=');
        std::optional<std::string> name = percent_decode(pair.substr(0, equals), true);
        std::optional<std::string> value = percent_decode(
            equals == std::string_view::npos ? "" : pair.substr(equals + 1), true);
        if (!name || !value || parsed.query.size() == kMaxQueryParameters ||
            !parsed.query.emplace(*std::move(name), *std::move(value)).second) {
            return std::nullopt;
        }
    }
    return parsed;
}

}  // namespace relume::net
