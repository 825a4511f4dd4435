// A few tiles that stand for the whole image.
#pragma once

#include "precompute/bake/rows/tile_window.h"
#include "protocol/transport/receiver_layout.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

struct SampleTile {
    std::uint32_t left = 0;  // pixels
    std::uint32_t top = 0;
};

// How many of the image's tiles: one of `every`, at least `least`, at most `most`.
struct SampleCount {
    std::uint32_t every = 16;
    std::size_t least = 1;
    std::size_t most = 16;
};

// Tiles spread evenly over those in whose middle the scene is seen, over all others where there
// are none; fewer than `least` where the image has fewer. Deterministic.
[[nodiscard]] std::vector<SampleTile> sample_tiles(const TileWindow& window,
                                                   const transport::TileGrid& image,
                                                   const SampleCount& count,
                                                   std::uint64_t seed);

}  // namespace relume::bake
