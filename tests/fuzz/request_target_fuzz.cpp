// Whatever the request line says, a parsed target keeps what its users rely on.
#include "server/net/http/request_target.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto target = relume::net::parse_request_target(text);
    if (!target) {
        return 0;
    }
    const std::string& path = target->path;
    const bool sound = path.front() == '/' && path.size() <= size &&
                       path.find('\0') == std::string::npos &&
                       path.find("/../") == std::string::npos && !path.ends_with("/..") &&
                       target->query.size() <= relume::net::kMaxQueryParameters;
    if (!sound) {
        std::abort();
    }
    return 0;
}
