// The relit image from the sums of its blocks.
#pragma once

#include "server/engine/scene.h"

#include <cstdint>
#include <span>

namespace relume::engine {

// Tiles side by side, [first, last) of a row of tiles.
struct TileRun {
    std::uint32_t row = 0;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

// Their pixels, without what of the tiles is beyond the image's edge.
struct PixelRect {
    std::uint32_t left = 0;
    std::uint32_t top = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};
[[nodiscard]] PixelRect pixels_of(const transport::TileGrid& image, const TileRun& tiles);

// `sums` are before tint, in the basis of the blocks (receiver_basis.h): [blocks][3][256]. The
// image has the tint applied: interleaved RGB, row by row from the top, 3·width·height floats
// (throws std::invalid_argument otherwise), linear radiance, premultiplied by coverage.
void write_relit_image(const Scene& scene, std::span<const float> sums, std::span<float> rgb);

// The same of a few tiles, as an image of their pixels alone: 3·width·height floats of these.
void write_relit_tiles(const Scene& scene,
                       std::span<const float> sums,
                       const TileRun& tiles,
                       std::span<float> rgb);

}  // namespace relume::engine
