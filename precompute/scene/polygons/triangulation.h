// Polygons into triangles, by the tessellator of the OpenGL utility library.
#pragma once

#include "precompute/scene/polygons/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relume::scene {

inline constexpr std::uint32_t kMaxPolygonCorners = 16384;

// Three places in PolygonMesh::corners, and the polygon they are part of.
struct CornerTriangle {
    std::array<std::uint32_t, 3> corner{};
    std::uint32_t polygon = 0;
};

// Fills every polygon by the even-odd rule, concave, with holes reached by a bridge, or
// crossing itself; where it crosses itself corners are added to the mesh. A polygon without
// area gives nothing. Throws SceneError (too_large) above kMaxPolygonCorners, or where more
// than `max_triangles` come of it.
[[nodiscard]] std::vector<CornerTriangle> triangulated(PolygonMesh& mesh,
                                                       std::uint64_t max_triangles);

}  // namespace relume::scene
