// Small Radiance files for tests.
#pragma once

#include <filesystem>

namespace relume::net {

// All texels alike.
void write_hdr(const std::filesystem::path& path, int width, int height, float radiance);

}  // namespace relume::net
