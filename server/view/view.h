// What makes pixels of the sums of a scene's receivers.
#pragma once

#include "protocol/transport/camera_record.h"
#include "protocol/transport/receiver_layout.h"
#include "server/view/tile_run.h"

#include <cstdint>
#include <span>

namespace relume::view {

// An image of what a scene's receivers have been given. Sums are [blocks][3][256], in the basis
// of their block and before tint (protocol/transport/block_basis.h). Each room has its own.
// Images are cut into tiles of 16×16 pixels, so that they can be made piece by piece.
//
// Not thread-safe, but for what is const: any number of threads may write tiles at a time.
class View {
  public:
    View() = default;
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    virtual ~View() = default;

    // The image's size, in tiles.
    [[nodiscard]] virtual const transport::TileGrid& image() const = 0;
    // Where it is looked from, and along which directions.
    [[nodiscard]] virtual const transport::CameraRecord& camera() const = 0;
    // The part of each pixel that sees the scene, in [0, 1]: row by row from the top,
    // width·height values.
    virtual void write_coverage(std::span<float> coverage) const = 0;

    // Prepares for the tiles of one image of these sums.
    virtual void begin_image(std::span<const float> sums) = 0;
    // Tiles of that image, tint applied: the pixels of `pixels_of(image(), tiles)` alone,
    // interleaved RGB, row by row from the top, linear radiance, premultiplied by coverage.
    // Throws std::invalid_argument for a buffer of another size.
    virtual void write_tiles(std::span<const float> sums,
                             const TileRun& tiles,
                             std::span<float> rgb) const = 0;
};

// The whole image, 3·width·height floats. Spread over the caller's arena.
void write_image(View& view, std::span<const float> sums, std::span<float> rgb);
// Throws std::invalid_argument unless the buffer holds these pixels.
void require_size(std::span<const float> rgb, const PixelRect& pixels);

}  // namespace relume::view
