// Directions at which functions of a direction are tabulated, and which of them are near
// another.
//
// Each face of the cube has side × side nodes, in equal angles from edge to edge:
// u = tan(π/4·(2i/(side − 1) − 1)) for column i, v alike for row i, with u and v as in
// cubemap.h. Node index: (face·side + row)·side + column. Nodes on the edges of faces are there
// two or three times, in one direction: what is interpolated within the faces is therefore
// continuous across their edges.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::tripling {

class DirectionGrid {
  public:
    static constexpr std::uint32_t kMostSide = 65;

    struct Node {
        std::size_t index = 0;
        float weight = 0;
    };

    // 2 to kMostSide nodes along a face's edge, or 1: one node for all directions, of no
    // particular one. Throws std::invalid_argument.
    explicit DirectionGrid(std::uint32_t side);

    [[nodiscard]] std::uint32_t side() const { return side_; }
    [[nodiscard]] std::size_t node_count() const {
        return side_ == 1 ? 1 : std::size_t{6} * side_ * side_;
    }
    // Unit; +z where side is 1.
    [[nodiscard]] Imath::V3f direction(std::size_t node) const;
    // The four nodes around a direction of any length but 0; weights are not negative and add
    // up to 1. With side 1 all weight is at node 0.
    [[nodiscard]] std::array<Node, 4> nodes_near(const Imath::V3f& direction) const;

    friend bool operator==(const DirectionGrid&, const DirectionGrid&) = default;

  private:
    std::uint32_t side_;
};

}  // namespace relume::tripling
