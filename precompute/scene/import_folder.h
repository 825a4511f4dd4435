// Files beside a scene: what it refers to by name is looked for in its own folder and below.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace relume::scene {

// `reference` as written in a scene file (slashes of either kind, percent escapes) as a path
// inside `folder`, or nothing where it leads out of it. Symbolic links are not followed here:
// they are the user's own.
[[nodiscard]] std::optional<std::filesystem::path> path_inside(
    const std::filesystem::path& folder, const std::string& reference);

// `%` and two hexadecimal digits stand for a byte; anything else stands for itself.
[[nodiscard]] std::string percent_decoded(const std::string& text);

}  // namespace relume::scene
