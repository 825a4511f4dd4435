// How a transport numbers its receivers: receiver ↔ (block, slot).
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>

namespace relume::transport {

// Where a receiver is stored.
struct ReceiverPlace {
    std::uint32_t block = 0;
    std::uint32_t slot = 0;  // below kBlockSize

    friend bool operator==(const ReceiverPlace&, const ReceiverPlace&) = default;
};

// Pixels of an image in tiles of 16×16, row by row from the top left. A tile is a block; tiles
// at the right and lower edge have slots without a pixel.
struct TileGrid {
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    [[nodiscard]] constexpr std::uint32_t tiles_x() const {
        return (width + kTileSide - 1) / kTileSide;
    }
    [[nodiscard]] constexpr std::uint32_t tiles_y() const {
        return (height + kTileSide - 1) / kTileSide;
    }
    [[nodiscard]] constexpr std::uint32_t block_count() const { return tiles_x() * tiles_y(); }
    [[nodiscard]] constexpr ReceiverPlace place_from_pixel(std::uint32_t x,
                                                           std::uint32_t y) const {
        return {.block = (y / kTileSide) * tiles_x() + x / kTileSide,
                .slot = (y % kTileSide) * kTileSide + x % kTileSide};
    }

    friend bool operator==(const TileGrid&, const TileGrid&) = default;
};

// A value. Code that knows nothing of pixels asks for receivers, blocks and slots; code that
// makes an image asks for the tiles as well.
class ReceiverLayout {
  public:
    // Receiver y·width + x is pixel (x, y). At least one pixel.
    [[nodiscard]] static constexpr ReceiverLayout pixel_tiles(const TileGrid& tiles) {
        return ReceiverLayout(tiles);
    }
    // Without receivers.
    constexpr ReceiverLayout() = default;

    [[nodiscard]] constexpr std::size_t receiver_count() const {
        return std::size_t{tiles_.width} * tiles_.height;
    }
    [[nodiscard]] constexpr std::uint32_t block_count() const { return tiles_.block_count(); }
    // Slots of all blocks, with and without a receiver.
    [[nodiscard]] constexpr std::size_t slot_count() const {
        return std::size_t{block_count()} * kBlockSize;
    }
    // Where a receiver, below receiver_count(), is stored.
    [[nodiscard]] constexpr ReceiverPlace place(std::size_t receiver) const {
        return tiles_.place_from_pixel(static_cast<std::uint32_t>(receiver % tiles_.width),
                                       static_cast<std::uint32_t>(receiver / tiles_.width));
    }
    [[nodiscard]] constexpr const TileGrid& tiles() const { return tiles_; }

  private:
    explicit constexpr ReceiverLayout(const TileGrid& tiles) : tiles_(tiles) {}

    TileGrid tiles_;
};

}  // namespace relume::transport
