// Text in parts.
#pragma once

#include <string_view>
#include <vector>

namespace relume::text {

// The parts between separators, empty ones too: one more than there are separators.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace relume::text
