#include "protocol/wire/json_text.h"

#include "protocol/wire/errors.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

ErrorCode code_of(text::JsonFault fault) {
    switch (fault) {
        case text::JsonFault::too_large:
            return ErrorCode::too_large;
        case text::JsonFault::number_out_of_range:
            return ErrorCode::out_of_range;
        case text::JsonFault::malformed:
            break;
    }
    return ErrorCode::malformed_json;
}

}  // namespace

nlohmann::json parse_json(std::string_view json, std::size_t max_bytes) {
    try {
        return text::parse_strict_json(json, max_bytes);
    } catch (const text::JsonError& error) {
        throw WireError(code_of(error.fault()), "", error.found(), error.expected());
    }
}

std::string pointer_step(std::string_view path, std::string_view key) {
    std::string pointer(path);
    pointer += '/';
    for (const char c : key) {
        if (c == '~') {
            pointer += "~0";
        } else if (c == '/') {
            pointer += "~1";
        } else {
            pointer += c;
        }
    }
    return pointer;
}

}  // namespace relume::wire
