// Neighbouring tiles of an image, and their pixels.
#pragma once

#include "protocol/transport/receiver_layout.h"

#include <algorithm>
#include <cstdint>

namespace relume::view {

// Neighbouring tiles of one row of tiles: [first, last).
struct TileRun {
    std::uint32_t row = 0;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

// A rectangle of pixels of the image.
struct PixelRect {
    std::uint32_t left = 0;
    std::uint32_t top = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    // Of interleaved RGB.
    [[nodiscard]] std::size_t float_count() const { return std::size_t{3} * width * height; }
};

// The pixels of these tiles, without those beyond the image's edge.
[[nodiscard]] inline PixelRect pixels_of(const transport::TileGrid& image,
                                         const TileRun& tiles) {
    const std::uint32_t left = tiles.first * transport::kTileSide;
    const std::uint32_t top = tiles.row * transport::kTileSide;
    return {.left = left,
            .top = top,
            .width = std::min(tiles.last * transport::kTileSide, image.width) - left,
            .height = std::min(transport::kTileSide, image.height - top)};
}

}  // namespace relume::view
