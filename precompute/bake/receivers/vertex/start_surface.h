// The surface of a scene before any edge is split: sides, creases and borders of materials told
// apart, and everything else joined.
#pragma once

#include "precompute/scene/scene.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

// Vertices at one point differ in normal, material or colour. Where corners of triangles do
// not, they are one vertex, whatever mesh they come from.
struct StartVertex {
    std::uint32_t point = 0;
    std::uint32_t material = 0;
    Imath::V3f normal{0, 1, 0};  // unit, on its triangles' side
};

// One side of a triangle of the scene.
struct StartTriangle {
    std::array<std::uint32_t, 3> vertices{};  // counter-clockwise seen from its side
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    bool is_behind = false;           // the second and third vertex are exchanged
    Imath::V3f face_normal{0, 1, 0};  // unit, on its side
    float reach = 0;                  // its largest coordinate
};

struct StartSurface {
    std::vector<Imath::V3f> points;  // all different
    std::vector<StartVertex> vertices;
    std::vector<StartTriangle> triangles;
    std::size_t dropped_triangles = 0;    // of the scene
    std::size_t two_sided_triangles = 0;  // of the scene
};

// Triangles of the scene for each vertex that may be, at most.
inline constexpr std::size_t kMostTrianglesPerVertex = 16;

// What refinement takes in memory for each vertex, about: a third of it the mesh, the rest the
// rows of the light's probe at the vertex and in the middles of the edges around it.
inline constexpr std::size_t kSurfaceBytesPerVertex = 3100;

// Triangles of solid parts (closed_parts.h) have their outer side alone, others both, as those
// of a material with holes do. Triangles without area, and those that lie where an
// earlier one does, are dropped. Throws BakeError where nothing is left, where the vertices are
// more than `most_vertices`, and where there are more than kMostTrianglesPerVertex triangles
// for each of those. Scenes that are far too large are found so by their points alone, at 20
// bytes for each vertex of the scene.
[[nodiscard]] StartSurface start_surface(const scene::Scene& scene, std::size_t most_vertices);

}  // namespace relume::bake
