// How a transport numbers its receivers: receiver ↔ (block, slot).
#pragma once

#include "protocol/transport/format.h"
#include "protocol/transport/vertex_clusters.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

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

// A value. Code that knows nothing of pixels or vertices asks for blocks and slots; code that
// makes an image asks for the tiles or the clusters.
class ReceiverLayout {
  public:
    // Receiver y·width + x is pixel (x, y). At least one pixel.
    [[nodiscard]] static ReceiverLayout pixel_tiles(const TileGrid& tiles) {
        return ReceiverLayout(tiles);
    }
    // Receivers are vertices.
    [[nodiscard]] static ReceiverLayout vertex_clusters(VertexClusters clusters) {
        return ReceiverLayout(std::move(clusters));
    }
    // Without receivers.
    ReceiverLayout() = default;

    [[nodiscard]] std::uint32_t block_count() const {
        return std::visit([](const auto& kind) { return kind.block_count(); }, kind_);
    }
    // Slots of all blocks, with and without a receiver.
    [[nodiscard]] std::size_t slot_count() const {
        return std::size_t{block_count()} * kBlockSize;
    }
    // Of pixel tiles. Throws std::bad_variant_access otherwise, as clusters() does.
    [[nodiscard]] const TileGrid& tiles() const { return std::get<TileGrid>(kind_); }
    [[nodiscard]] const VertexClusters& clusters() const {
        return std::get<VertexClusters>(kind_);
    }

  private:
    explicit ReceiverLayout(std::variant<TileGrid, VertexClusters> kind)
        : kind_(std::move(kind)) {}

    std::variant<TileGrid, VertexClusters> kind_;
};

}  // namespace relume::transport
