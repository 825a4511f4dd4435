// Where refinement looks at the light: at vertices, in the middles of chords, within triangles.
#pragma once

#include "precompute/bake/receivers/vertex/split_mesh.h"
#include "precompute/bake/receivers/vertex/surface_probe.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Rays leave the surface a little inside the triangles around the point, as they do for the
// vertices of a finished surface (vertex_places.h), but never further from the point than a
// small part of the scene: triangles are large at first, and their vertices are not looked at
// again when they are cut. Thread-safe as long as the mesh is not split.
class ProbePoints {
  public:
    explicit ProbePoints(const SplitMesh& mesh);

    // A vertex of the start surface, before the first split.
    [[nodiscard]] ProbePoint at_start_vertex(std::uint32_t vertex) const;
    [[nodiscard]] ProbePoint in_chord(std::uint32_t chord) const;
    // `corner_weights` of the triangle's second and third corner.
    [[nodiscard]] ProbePoint in_triangle(std::uint32_t triangle,
                                         const Imath::V2f& corner_weights) const;

  private:
    // A triangle around a point: from the point a sector opens from one place to another.
    struct Sector {
        std::uint32_t triangle = 0;
        Imath::V3f from{0, 0, 0};
        Imath::V3f to{0, 0, 0};
    };

    void spread_origins(std::span<const Sector> sectors, ProbePoint& point) const;

    const SplitMesh& mesh_;
    float farthest_ = 0;                            // from the point to an origin
    std::vector<std::uint32_t> first_triangle_at_;  // [vertices of the start + 1]
    std::vector<std::uint32_t> triangles_at_;
};

}  // namespace relume::bake
