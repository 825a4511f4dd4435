// The programs that belong together, built beside this one, as processes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace relume::bench {

[[nodiscard]] std::filesystem::path bake_program();
[[nodiscard]] std::filesystem::path server_program();
[[nodiscard]] std::filesystem::path client_program();

// Waits for its end and returns its standard output. What it writes is kept in `folder` under
// `name`. Throws std::runtime_error with its standard error when it fails.
std::string run_to_end(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder,
                       const std::string& name);

}  // namespace relume::bench
