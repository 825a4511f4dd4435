// Whether clusters show: jumps of radiance along edges of the mesh, across borders of clusters
// and within them.
#pragma once

#include "tests/lab/cpca/vertex_rows.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::lab {

// Ratios of root mean squares, across borders over within: of the jumps that coding adds, which
// are the coded jumps less the exact ones, edge by edge; and of the coded jumps, over the same
// ratio of the exact ones. 1 where there is no border, or nothing is added.
struct SeamFigures {
    double added = 1;
    double shown = 1;
    std::size_t border_edges = 0;
    std::size_t inner_edges = 0;
};

// Answers are by vertex, [planes][lights]; lights [first, last) count.
[[nodiscard]] SeamFigures measure_seams(const VertexRows& rows,
                                        std::span<const std::uint32_t> cluster_of,
                                        std::span<const float> exact,
                                        std::span<const float> coded,
                                        std::size_t lights,
                                        std::size_t first,
                                        std::size_t last);

}  // namespace relume::lab
