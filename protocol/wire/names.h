// The one rule for names of rooms, scenes, environments and lights: 1 to 64 characters of
// [A-Za-z0-9._-], the first of them not a dot, so that a name is always a safe file name and
// never a relative path.
#pragma once

#include <cstddef>
#include <string_view>

namespace relume::wire {

inline constexpr std::size_t kMaxNameLength = 64;
inline constexpr std::string_view kNameRule =
    "1 to 64 characters of [A-Za-z0-9._-], not beginning with a dot";

[[nodiscard]] bool is_name(std::string_view text);

}  // namespace relume::wire
