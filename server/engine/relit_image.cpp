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

void write_block(const Scene& scene,
                 std::span<const float> sums,
                 std::uint32_t block,
                 std::span<float> rgb) {
    const std::size_t first = block * std::size_t{kColours} * kBlockSize;
    const transport::TileGrid& image = scene.image();
    const std::uint32_t left = block % image.tiles_x() * kTileSide;
    const std::uint32_t top = block / image.tiles_x() * kTileSide;
    write_block_pixels(&sums[first], &scene.transport().tint()[first],
                       {.first = &rgb[kColours * (std::size_t{top} * image.width + left)],
                        .row_floats = std::size_t{kColours} * image.width,
                        .columns = std::min(kTileSide, image.width - left),
                        .rows = std::min(kTileSide, image.height - top)});
}

}  // namespace

void write_relit_image(const Scene& scene, std::span<const float> sums, std::span<float> rgb) {
    const transport::TileGrid& image = scene.image();
    const std::size_t expected = std::size_t{kColours} * image.width * image.height;
    if (rgb.size() != expected) {
        throw std::invalid_argument(
            fmt::format("image buffer has {} values, expected {}", rgb.size(), expected));
    }
    tbb::parallel_for(std::uint32_t{0}, image.block_count(),
                      [&](std::uint32_t block) { write_block(scene, sums, block, rgb); });
}

}  // namespace relume::engine
