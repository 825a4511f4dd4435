// A look at a few tiles before the bake: how many channels the transport needs, and how finely
// each column is to be quantised (step_chooser.h).
#pragma once

#include "precompute/bake/rows/row_baker.h"
#include "precompute/bake/rows/tile_window.h"
#include "protocol/transport/manifest.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

struct Quantisation {
    transport::ColourModel colour;
    std::vector<float> steps;    // [N][K]
    double chroma_residual = 0;  // relative L2 of what one channel would lose
};

// Deterministic, on any number of threads.
[[nodiscard]] Quantisation plan_quantisation(const RowBaker& rows,
                                             const TileWindow& window,
                                             const transport::TileGrid& image,
                                             const BakeParameters& parameters);

// The pixels in which the bake measures its quantisation error, 2×2 in every tile: whether
// (x, y) is one of them.
[[nodiscard]] constexpr bool is_measured_pixel(std::uint32_t x, std::uint32_t y) {
    constexpr std::uint32_t kFirst = 7;
    const std::uint32_t column = x % transport::kTileSide;
    const std::uint32_t row = y % transport::kTileSide;
    return column >= kFirst && column < kFirst + 2 && row >= kFirst && row < kFirst + 2;
}

}  // namespace relume::bake
