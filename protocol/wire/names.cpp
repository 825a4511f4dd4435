#include "protocol/wire/names.h"

#include <algorithm>

namespace relume::wire {
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

}  // namespace relume::wire
