// The image of one fixed camera, from the sums of its receivers.
#pragma once

#include "protocol/transport/transport.h"

#include <cstdint>
#include <memory>
#include <span>

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
};
// The pixels of these tiles, without those beyond the image's edge.
[[nodiscard]] PixelRect pixels_of(const transport::TileGrid& image, const TileRun& tiles);

// Receivers are pixels, and a block is a tile of 16×16 of them. Sums are [blocks][3][256], in
// the basis of their block and before tint (protocol/transport/block_basis.h). Immutable; safe
// to share between threads.
class ImageView {
  public:
    explicit ImageView(std::shared_ptr<const transport::Transport> transport);

    [[nodiscard]] const transport::TileGrid& image() const {
        return transport_->manifest().image();
    }
    [[nodiscard]] const transport::CameraRecord& camera() const {
        return transport_->manifest().camera;
    }
    // The part of each pixel that sees the scene, [blocks][256], in [0, 1].
    [[nodiscard]] std::span<const float> coverage() const { return transport_->coverage(); }

    // The relit image, tint applied: interleaved RGB, row by row from the top,
    // 3·width·height floats (throws std::invalid_argument otherwise), linear radiance,
    // premultiplied by coverage. Spread over the caller's arena.
    void write_image(std::span<const float> sums, std::span<float> rgb) const;
    // The same for a few tiles: writes an image of `pixels_of(image(), tiles)` alone.
    void write_tiles(std::span<const float> sums,
                     const TileRun& tiles,
                     std::span<float> rgb) const;

  private:
    void write_block(std::span<const float> sums,
                     std::uint32_t block,
                     const PixelRect& pixels,
                     std::span<float> rgb) const;

    std::shared_ptr<const transport::Transport> transport_;
};

}  // namespace relume::view
