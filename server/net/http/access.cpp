#include "server/net/http/access.h"

#include "server/net/http/subprotocols.h"

#include <cstddef>

namespace relume::net {

namespace {

constexpr std::string_view kBearer = "Bearer ";

// In a time that does not tell how much of the guess was right.
bool equal_in_constant_time(std::string_view guess, std::string_view secret) {
    unsigned difference = guess.size() == secret.size() ? 0U : 1U;
    for (std::size_t i = 0; i < guess.size(); ++i) {
        const char expected = secret[i % secret.size()];
        difference |= static_cast<unsigned char>(guess[i]) ^
                      static_cast<unsigned>(static_cast<unsigned char>(expected));
    }
    return difference == 0;
}

}  // namespace

Role Access::role_of(const HttpRequest& request) const {
    return has_token(request) ? Role::editor : Role::none;
}

bool Access::has_token(const HttpRequest& request) const {
    if (token_.empty()) {
        return true;
    }
    if (request.authorization && request.authorization->starts_with(kBearer)) {
        return equal_in_constant_time(
            std::string_view(*request.authorization).substr(kBearer.size()), token_);
    }
    if (const auto offered = token_from_subprotocols(request.subprotocols)) {
        return equal_in_constant_time(*offered, token_);
    }
    const std::optional<std::string> parameter = request.target.parameter("token");
    return parameter && equal_in_constant_time(*parameter, token_);
}

}  // namespace relume::net
