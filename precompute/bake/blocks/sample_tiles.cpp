#include "precompute/bake/blocks/sample_tiles.h"

#include "protocol/transport/hash.h"

#include <algorithm>

namespace relume::bake {

std::vector<SampleTile> sample_tiles(const TileWindow& window,
                                     const transport::TileGrid& image,
                                     const SampleCount& count,
                                     std::uint64_t seed) {
    std::vector<SampleTile> tiles;
    std::vector<SampleTile> occupied;
    for (std::uint32_t block = 0; block < image.block_count(); ++block) {
        const SampleTile tile{.left = block % image.tiles_x() * transport::kTileSide,
                              .top = block / image.tiles_x() * transport::kTileSide};
        const std::uint32_t x = std::min(tile.left + transport::kTileSide / 2, image.width - 1);
        const std::uint32_t y = std::min(tile.top + transport::kTileSide / 2, image.height - 1);
        tiles.push_back(tile);
        if (window.surface_count(x, y) > 0) {
            occupied.push_back(tile);
        }
    }
    const std::vector<SampleTile>& from = occupied.empty() ? tiles : occupied;
    const std::size_t wanted =
        std::min(std::clamp<std::size_t>(from.size() / count.every, count.least, count.most),
                 from.size());
    std::vector<SampleTile> chosen;
    for (std::size_t i = 0; i < wanted; ++i) {
        const double jitter = double{transport::unit_float(transport::mix_bits(seed + i))};
        const double place = (static_cast<double>(i) + jitter) / static_cast<double>(wanted);
        chosen.push_back(
            from[static_cast<std::size_t>(place * static_cast<double>(from.size()))]);
    }
    return chosen;
}

}  // namespace relume::bake
