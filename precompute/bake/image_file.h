// Images to files through OpenImageIO, whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::bake {

struct FloatImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;  // 1: Y or Z, 3: RGB, 4: RGBA
    std::vector<float> values;   // height·width·channels
};

// Float EXR, zip. Throws BakeError, files::FileError.
void write_exr(const std::filesystem::path& path, const FloatImage& image);
// 8-bit PNG of display-referred values in [0, 1]. Throws as write_exr does.
void write_png(const std::filesystem::path& path, const FloatImage& image);
[[nodiscard]] FloatImage resized(const FloatImage& image,
                                 std::uint32_t width,
                                 std::uint32_t height);

}  // namespace relume::bake
