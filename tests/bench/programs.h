// The programs that belong together, built beside this one.
#pragma once

#include <filesystem>

namespace relume::bench {

[[nodiscard]] std::filesystem::path server_program();
[[nodiscard]] std::filesystem::path client_program();

}  // namespace relume::bench
