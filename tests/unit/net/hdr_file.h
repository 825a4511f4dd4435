// Small Radiance files for tests.
#pragma once

#include <filesystem>
#include <string>

namespace relume::net {

// All texels alike.
void write_hdr(const std::filesystem::path& path, int width, int height, float radiance);
// Such a file as clients send it.
[[nodiscard]] std::string hdr_file(int width = 32, int height = 16);

}  // namespace relume::net
