// Which triangle is nearest in every pixel of a small square of an image.
#pragma once

#include "server/view/mesh/projected_triangle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace relume::view {

inline constexpr std::uint32_t kRasterSide = 32;
inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

// Where in a pixel it is looked; (0.5, 0.5) is its middle. Multiples of 1/32.
struct SamplePosition {
    double x = 0.5;
    double y = 0.5;
};

struct alignas(64) RasterTile {
    // Rows are longer than the tile, so that whole vectors can be written at its end.
    static constexpr std::size_t kRow = kRasterSide + 8;
    template <typename Value>
    using Values = std::array<Value, kRow * kRasterSide>;

    Values<float> nearness;            // one over the depth; 0 where nothing is hit
    Values<std::uint32_t> triangle;    // kNoTriangle where nothing is hit
    Values<float> weight_1, weight_2;  // of the triangle's second and third corner

    void clear();
};

// Draws the triangles with these numbers into a tile whose first pixel is (left, top), beside
// what is in it. Of equally near ones the first that is drawn stays. Every instruction set
// gives the same bits.
void draw(std::span<const ProjectedTriangle> triangles,
          std::span<const std::uint32_t> numbers,
          std::uint32_t left,
          std::uint32_t top,
          const SamplePosition& sample,
          RasterTile& tile);

}  // namespace relume::view
