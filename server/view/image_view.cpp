#include "server/view/image_view.h"

#include "server/view/block_pixels.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace relume::view {

using transport::kBlockSize;
using transport::kColours;
using transport::kTileSide;

ImageView::ImageView(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)) {}

void ImageView::write_coverage(std::span<float> coverage) const {
    const std::span<const float> by_slot = transport_->coverage();
    for (std::uint32_t y = 0; y < image().height; ++y) {
        for (std::uint32_t x = 0; x < image().width; ++x) {
            const transport::ReceiverPlace place = image().place_from_pixel(x, y);
            coverage[std::size_t{y} * image().width + x] =
                by_slot[std::size_t{place.block} * kBlockSize + place.slot];
        }
    }
}

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
