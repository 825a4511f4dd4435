// From the radiance of vertices to the pixels of a tile.
#pragma once

#include "server/view/mesh/tile_terms.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::view {

// Writes the pixels of a tile, `columns` in a row, interleaved RGB, a row every `row_floats`.
// `radiance` is VertexRadiance::values. Every processor gives the same bits.
void write_tile_pixels(const TileTerms& terms,
                       std::span<const float> radiance,
                       std::uint32_t columns,
                       std::size_t row_floats,
                       float* first);

}  // namespace relume::view
