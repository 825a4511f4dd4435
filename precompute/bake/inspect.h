// What a transport directory is, and whether it is whole.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace relume::bake {

// All there is to say about it, for `info --json`; checks everything on the way. Throws
// transport::TransportError.
[[nodiscard]] nlohmann::json describe(const std::filesystem::path& directory);
// The same for people, a few lines.
[[nodiscard]] std::string text_from_description(const nlohmann::json& description);

// What an exact image of it is exact for: one line. `basis` is the description's.
[[nodiscard]] std::string exactness_text(const nlohmann::json& basis);

// Every fault that reading each file of the directory to its last byte finds; none: it is
// whole.
[[nodiscard]] std::vector<std::string> find_faults(const std::filesystem::path& directory);

}  // namespace relume::bake
