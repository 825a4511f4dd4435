// Indirect light of a pixel from its own paths and those of neighbours that see much the same.
//
// A neighbour's paths count by its distance in the image, in the plane of the surface, in
// orientation and, for glossy surfaces, in the direction of the mirror image; only surfaces of
// one material are pooled. Near other surfaces indirect light changes fast, so there the pool
// narrows with the harmonic mean distance to what is around [Ward88]. Weights depend on the
// geometry alone, never on what the paths found: pooling blurs, it does not skew.
#pragma once

#include "precompute/bake/rows/escape_sum.h"
#include "precompute/bake/rows/tile_window.h"

#include <cstdint>

namespace relume::bake {

class PathPool {
  public:
    PathPool(const TileWindow& window, std::uint32_t radius)
        : window_(window), radius_(radius) {}

    // Adds the pooled paths of one surface of pixel (x, y), without its reflectance. The pixel
    // and those within the radius are in the window. Thread-safe for different sums.
    void gather(std::uint32_t x,
                std::uint32_t y,
                std::uint32_t surface,
                EscapeSum& escapes) const;

  private:
    const TileWindow& window_;
    std::uint32_t radius_;
};

}  // namespace relume::bake
