// What turns the radiance of vertices into the pixels of one tile.
#pragma once

#include "protocol/transport/format.h"
#include "server/view/mesh/drawn_surface.h"
#include "server/view/mesh/given_radiance.h"
#include "server/view/mesh/pixel_space.h"
#include "server/view/mesh/visible_surface.h"
#include "server/view/tile_run.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

// A point of the surface that shows. With R_k(v) the radiance of term k at vertex v, it sends
// Σ_k weight_k · Σ_corners share · R_k(corner) towards the eye, by colour.
struct TilePoint {
    std::array<std::uint32_t, 3> first_terms{};  // of its corners (DrawnSurface)
    std::array<float, 3> shares{};
    std::uint32_t terms = 0;
};

// A pixel is the mean of its places, of which some show a point and the others nothing.
struct TilePixel {
    std::uint16_t points = 0;
    std::uint16_t places = 1;
};

// Points and pixels in the order of the tile, row by row. Memory stays from one tile to the
// next.
struct TileTerms {
    std::vector<TilePixel> pixels;
    std::vector<TilePoint> points;
    // Of every point, one term after the other: red, green, blue and 0. A term's weight is the
    // sum over the material's lobes of colour times h, in the frame of the interpolated normal.
    std::vector<float> weights;
};

// Replaces the content of `terms` with that of the tile that has these pixels. Points of
// materials that are `given` their radiance, if any is, have one term of weight 1. A pure
// function; may run on several threads.
void make_tile_terms(const DrawnSurface& surface,
                     const VisibleSurface& visible,
                     const Pinhole& pinhole,
                     const PixelRect& pixels,
                     const GivenRadiance* given,
                     TileTerms& terms);

}  // namespace relume::view
