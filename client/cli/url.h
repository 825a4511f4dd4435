// Where a server is: http://HOST[:PORT][/PREFIX] or ws://…, which name the same port.
#pragma once

#include <string>
#include <string_view>

namespace relume::cli {

struct Url {
    std::string host;  // without the brackets of an IPv6 address
    std::string port = "80";
    std::string prefix;  // "" or "/some/path", without a slash at the end

    // As the Host header wants it.
    [[nodiscard]] std::string authority() const;

    friend bool operator==(const Url&, const Url&) = default;
};

// Throws ClientError.
[[nodiscard]] Url url_from_text(std::string_view text);

// Percent-encodes all but the unreserved characters [RFC 3986 §2.3].
[[nodiscard]] std::string percent_encoded(std::string_view text);

}  // namespace relume::cli
