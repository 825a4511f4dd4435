#include "tests/lab/methods/numbered_part.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace relume::lab {

std::uint32_t take_numbered_part(char letter,
                                 std::string_view meaning,
                                 std::string_view& text) {
    const std::string_view part = text.substr(0, text.find('-'));
    std::uint32_t number = 0;
    const bool has_letter = !part.empty() && part[0] == letter;
    const char* const last = part.data() + part.size();
    if (!has_letter || part.size() == text.size() ||
        std::from_chars(part.data() + 1, last, number).ptr != last || number == 0) {
        throw std::invalid_argument(fmt::format("'{}', expected {} and a dash: {}, as {}30-",
                                                text, letter, meaning, letter));
    }
    text.remove_prefix(part.size() + 1);
    return number;
}

}  // namespace relume::lab
