// Pictures side by side, each with a line below that says what it is.
#pragma once

#include "tests/stability/relit_image.h"

#include <filesystem>
#include <span>
#include <string>

namespace relume::stability {

struct Tile {
    RelitImage image;
    std::string caption;
    float exposure_stops = 0;
};

// A tile that shows a planar lighting cubemap of [3][6n²] radiance as the six faces side by
// side: +X −X +Y −Y +Z −Z.
[[nodiscard]] RelitImage image_of_faces(std::span<const float> radiance,
                                        std::uint32_t face_resolution);

// Brings the brightest hundredth of the reference to white.
[[nodiscard]] float exposure_for(const RelitImage& reference);

// 8-bit PNG, at most `columns` tiles in a row, each enlarged by whole factors. Throws
// std::runtime_error when it cannot be written.
void write_contact_sheet(const std::filesystem::path& file,
                         std::span<const Tile> tiles,
                         std::size_t columns = 4);

}  // namespace relume::stability
