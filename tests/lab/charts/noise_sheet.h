// A bake's picture beside its reference, enlarged pixel by pixel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::lab {

// Pixels [left, left + width) × [top, top + height).
struct Crop {
    std::uint32_t left = 0;
    std::uint32_t top = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

// Writes a PNG: the pictures from left to right, each pixel a square, shown as the server's
// images are with the exposure of display_exposure.h for the first, the reference. Pictures are
// interleaved RGB, `image_width` pixels wide. Throws bake::BakeError, files::FileError.
void write_noise_sheet(const std::filesystem::path& path,
                       const std::vector<std::vector<float>>& pictures,
                       std::uint32_t image_width,
                       const Crop& crop);

// What an EXR holds, interleaved RGB. Throws bake::BakeError when it is not there or not of
// this size.
[[nodiscard]] std::vector<float> read_picture(const std::filesystem::path& path,
                                              std::uint32_t width,
                                              std::uint32_t height);

}  // namespace relume::lab
