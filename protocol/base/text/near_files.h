// What somebody may have meant by the name of a file that does not exist.
#pragma once

#include <filesystem>
#include <string>

namespace relume::text {

// "no such file or folder", and what lies beside the path under a name that resembles its own:
// "; did you mean scenes/table.glb?".
[[nodiscard]] std::string text_from_missing_file(const std::filesystem::path& path);

}  // namespace relume::text
