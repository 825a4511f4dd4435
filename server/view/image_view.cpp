#include "server/view/image_view.h"

#include "server/view/block_pixels.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace relume::view {
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

}  // namespace

PixelRect pixels_of(const transport::TileGrid& image, const TileRun& tiles) {
    const std::uint32_t left = tiles.first * kTileSide;
    const std::uint32_t top = tiles.row * kTileSide;
    return {.left = left,
            .top = top,
            .width = std::min(tiles.last * kTileSide, image.width) - left,
            .height = std::min(kTileSide, image.height - top)};
}

ImageView::ImageView(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)) {}

// Into an image that begins with these pixels.
void ImageView::write_block(std::span<const float> sums,
                            std::uint32_t block,
                            const PixelRect& pixels,
                            std::span<float> rgb) const {
    const std::size_t first = block * std::size_t{kColours} * kBlockSize;
    const std::uint32_t tiles_x = image().tiles_x();
    const std::uint32_t left = block % tiles_x * kTileSide - pixels.left;
    const std::uint32_t top = block / tiles_x * kTileSide - pixels.top;
    write_block_pixels(&sums[first], &transport_->tint()[first],
                       {.first = &rgb[kColours * (std::size_t{top} * pixels.width + left)],
                        .row_floats = std::size_t{kColours} * pixels.width,
                        .columns = std::min(kTileSide, pixels.width - left),
                        .rows = std::min(kTileSide, pixels.height - top)});
}

void ImageView::write_image(std::span<const float> sums, std::span<float> rgb) const {
    const PixelRect all{.width = image().width, .height = image().height};
    require_size(rgb, all);
    tbb::parallel_for(std::uint32_t{0}, image().block_count(),
                      [&](std::uint32_t block) { write_block(sums, block, all, rgb); });
}

void ImageView::write_tiles(std::span<const float> sums,
                            const TileRun& tiles,
                            std::span<float> rgb) const {
    const PixelRect pixels = pixels_of(image(), tiles);
    require_size(rgb, pixels);
    for (std::uint32_t tile = tiles.first; tile < tiles.last; ++tile) {
        write_block(sums, tiles.row * image().tiles_x() + tile, pixels, rgb);
    }
}

}  // namespace relume::view
