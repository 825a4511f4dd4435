// Numbers in a method's name that a letter tells apart: "c40-s16-30".
#pragma once

#include <cstdint>
#include <string_view>

namespace relume::lab {

// Takes LETTER, a number from 1 on, and a dash off the front of `text`. Throws
// std::invalid_argument saying what the number is (`meaning`), what was found and expected.
[[nodiscard]] std::uint32_t take_numbered_part(char letter,
                                               std::string_view meaning,
                                               std::string_view& text);

}  // namespace relume::lab
