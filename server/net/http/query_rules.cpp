#include "server/net/http/query_rules.h"

#include "server/net/http/subprotocols.h"
#include "server/net/images/image_interest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

namespace relume::net {

using wire::ErrorCode;
using wire::WireError;

std::optional<HttpReply> fault_of_query(const RequestTarget& target,
                                        std::initializer_list<std::string_view> known) {
    for (const auto& [name, value] : target.query) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            return error_reply(
                400, WireError(ErrorCode::unknown_field, name,
                               fmt::format("the parameter {:?}", name),
                               known.size() == 0
                                   ? std::string("no parameters")
                                   : fmt::format("one of {}", fmt::join(known, ", "))));
        }
    }
    return std::nullopt;
}

std::optional<HttpReply> fault_of_session_request(const HttpRequest& request) {
    if (auto fault = fault_of_query(request.target, {"scene", "images", "token"})) {
        return fault;
    }
    const std::optional<std::string> images = request.target.parameter("images");
    if (images && !kImageInterestNames.value(*images)) {
        return error_reply(400, WireError(ErrorCode::unknown_name, "images", *images,
                                          kImageInterestNames.alternatives()));
    }
    if (offers_other_versions_only(request.subprotocols)) {
        return error_reply(400, WireError(ErrorCode::unsupported, "Sec-WebSocket-Protocol",
                                          *request.subprotocols, std::string(kSubprotocol)));
    }
    return std::nullopt;
}

}  // namespace relume::net
