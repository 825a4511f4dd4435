#include "server/engine/relit_image.h"

#include "server/engine/kernels/block_pixels.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;
using transport::kTileSide;

std::size_t float_count(const PixelRect& pixels) {
    return std::size_t{kColours} * pixels.width * pixels.height;
}

void require_size(std::span<const float> rgb, const PixelRect& pixels) {
    if (rgb.size() != float_count(pixels)) {
        throw std::invalid_argument(fmt::format("image buffer has {} values, expected {}",
                                                rgb.size(), float_count(pixels)));
    }
}

// Into an image that begins with these pixels.
void write_block(const Scene& scene,
                 std::span<const float> sums,
                 std::uint32_t block,
                 const PixelRect& pixels,
                 std::span<float> rgb) {
    const std::size_t first = block * std::size_t{kColours} * kBlockSize;
    const std::uint32_t tiles_x = scene.image().tiles_x();
    const std::uint32_t left = block % tiles_x * kTileSide - pixels.left;
    const std::uint32_t top = block / tiles_x * kTileSide - pixels.top;
    write_block_pixels(&sums[first], &scene.transport().tint()[first],
                       {.first = &rgb[kColours * (std::size_t{top} * pixels.width + left)],
                        .row_floats = std::size_t{kColours} * pixels.width,
                        .columns = std::min(kTileSide, pixels.width - left),
                        .rows = std::min(kTileSide, pixels.height - top)});
}

}  // namespace

PixelRect pixels_of(const transport::TileGrid& image, const TileRun& tiles) {
    const std::uint32_t left = tiles.first * kTileSide;
    const std::uint32_t top = tiles.row * kTileSide;
    return {.left = left,
            .top = top,
            .width = std::min(tiles.last * kTileSide, image.width) - left,
            .height = std::min(kTileSide, image.height - top)};
}

void write_relit_image(const Scene& scene, std::span<const float> sums, std::span<float> rgb) {
    const transport::TileGrid& image = scene.image();
    const PixelRect all{.width = image.width, .height = image.height};
    require_size(rgb, all);
    tbb::parallel_for(std::uint32_t{0}, image.block_count(),
                      [&](std::uint32_t block) { write_block(scene, sums, block, all, rgb); });
}

void write_relit_tiles(const Scene& scene,
                       std::span<const float> sums,
                       const TileRun& tiles,
                       std::span<float> rgb) {
    const PixelRect pixels = pixels_of(scene.image(), tiles);
    require_size(rgb, pixels);
    for (std::uint32_t tile = tiles.first; tile < tiles.last; ++tile) {
        write_block(scene, sums, tiles.row * scene.image().tiles_x() + tile, pixels, rgb);
    }
}

}  // namespace relume::engine
