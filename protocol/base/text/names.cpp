#include "protocol/base/text/names.h"

#include <algorithm>

namespace relume::text {
namespace {

bool is_name_character(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
           c == '.' || c == '_' || c == '-';
}

}  // namespace

bool is_name(std::string_view text) {
    return !text.empty() && text.size() <= kMaxNameLength && text.front() != '.' &&
           std::all_of(text.begin(), text.end(), is_name_character);
}

bool is_label(std::string_view text) {
    std::size_t code_points = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x20 || byte == 0x7f) {
            return false;
        }
        // U+0080 to U+009F are C2 80 to C2 9F.
        if (byte == 0xc2 && i + 1 < text.size() &&
            static_cast<unsigned char>(text[i + 1]) < 0xa0) {
            return false;
        }
        const bool is_continuation = (byte & 0xc0) == 0x80;
        code_points += is_continuation ? 0 : 1;
    }
    return code_points >= 1 && code_points <= kMaxLabelLength;
}

}  // namespace relume::text
