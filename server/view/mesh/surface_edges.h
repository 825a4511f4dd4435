// The pixels of an image in which different things meet.
#pragma once

#include "protocol/transport/surface_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

struct SurfacePoint;

// Those beside one that shows something else: surface beside none, another material, another
// side of a crease, or a surface in front of one behind. `points` and `nearness` (one over the
// depth along forward) are of the middles of width·height pixels, row by row. In ascending
// order.
[[nodiscard]] std::vector<std::uint32_t> pixels_of_edges(const transport::SurfaceMesh& mesh,
                                                         std::span<const SurfacePoint> points,
                                                         std::span<const float> nearness,
                                                         std::uint32_t width,
                                                         std::uint32_t height);

}  // namespace relume::view
