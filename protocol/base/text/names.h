// The one rule for names of rooms, scenes, environments and lights: 1 to 64 characters of
// [A-Za-z0-9._-], the first of them not a dot, so that a name is always a safe file name and
// never a relative path.
#pragma once

#include <cstddef>
#include <string_view>

namespace relume::text {

inline constexpr std::size_t kMaxNameLength = 64;
inline constexpr std::string_view kNameRule =
    "1 to 64 characters of [A-Za-z0-9._-], not beginning with a dot";

[[nodiscard]] bool is_name(std::string_view text);

// What people call a light: 1 to 64 code points, none of them a control character (U+0000 to
// U+001F, U+007F to U+009F). Only shown, so it may be of any script.
inline constexpr std::size_t kMaxLabelLength = 64;
inline constexpr std::string_view kLabelRule =
    "1 to 64 characters, none of them a control character";

// `text` is valid UTF-8, as strict JSON sees to.
[[nodiscard]] bool is_label(std::string_view text);

}  // namespace relume::text
