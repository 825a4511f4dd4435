// Text from a file, made fit to be shown and to be written into a manifest.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace relume::scene {

// `text` with every byte that is no well-formed UTF-8 (RFC 3629), and every control character,
// as `\xNN`: a name of any bytes becomes text that can be printed and put into JSON.
[[nodiscard]] std::string shown_text(std::string_view text);

// Length in bytes of the UTF-8 sequence at the start of `text`: 1 to 4, or 0 where there is
// none.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

}  // namespace relume::scene
