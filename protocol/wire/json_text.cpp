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

namespace {

// Of a key in a path: who sends keys without end gets them back once, and not in full.
constexpr std::size_t kMaxPointerKeyBytes = 128;

}  // namespace

std::string pointer_step(std::string_view path, std::string_view key) {
    std::string pointer(path);
    pointer += '/';
    const bool is_cut = key.size() > kMaxPointerKeyBytes;
    if (is_cut) {
        std::size_t end = kMaxPointerKeyBytes;
        while (end > 0 && (static_cast<unsigned char>(key[end]) & 0xC0U) == 0x80U) {
            --end;  // within a character of UTF-8
        }
        key = key.substr(0, end);
    }
    for (const char c : key) {
        if (c == '~') {
            pointer += "~0";
        } else if (c == '/') {
            pointer += "~1";
        } else {
            pointer += c;
        }
    }
    return is_cut ? pointer + "…" : pointer;
}

}  // namespace relume::wire
