// Which vertices share an edge.
#pragma once

#include <cstdint>
#include <vector>

namespace relume::lab {

// Neighbours of v are neighbours[first[v] … first[v + 1]), ascending.
struct VertexGraph {
    std::vector<std::uint32_t> first{0};  // [V + 1]
    std::vector<std::uint32_t> neighbours;
};

}  // namespace relume::lab
