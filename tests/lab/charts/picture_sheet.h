// Pictures side by side, with their errors beneath.
#pragma once

#include "tests/lab/measures/experiment.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// Writes STEM.png: one column for the reference and each method, tone-mapped as the server's
// images are with an exposure that gives the reference a mean luminance of 0.18; beneath, the
// absolute error of its display values, four times as bright. `pictures` are of one image, the
// reference first, `width` pixels wide. Throws as draw_chart does.
void draw_picture_sheet(const std::filesystem::path& stem,
                        const std::string& title,
                        const std::vector<Picture>& pictures,
                        std::uint32_t width);

// Writes STEM.png: pictures of one image in rows of `columns`, tone-mapped with an exposure
// that gives `reference` a mean luminance of 0.18, each under its name. Throws as draw_chart
// does.
void draw_picture_grid(const std::filesystem::path& stem,
                       const std::string& title,
                       const std::vector<float>& reference,
                       const std::vector<Picture>& pictures,
                       std::size_t columns,
                       std::uint32_t width);

}  // namespace relume::lab
