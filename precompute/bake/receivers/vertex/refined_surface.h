// A scene's surface, cut finely enough that light can be interpolated between its vertices.
//
// The vertices are the receivers of a transport of kind `mesh`, in the order in which they are
// stored. Rays still meet the scene as it was given: every refined triangle lies on one of the
// scene's, and says where.
#pragma once

#include "protocol/transport/surface_mesh.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Where a refined triangle lies: corner i is at barycentrics[i] of a triangle of the scene,
// which weigh its second and third vertex as scene::surface_point takes them.
struct TriangleOrigin {
    std::uint32_t mesh = 0;      // of Scene::meshes
    std::uint32_t triangle = 0;  // of Mesh::triangles
    // Seen from behind: the corners run the other way round than the scene's triangle does.
    bool is_behind = false;
    std::array<Imath::V2f, 3> barycentrics{};
};

// Vertices [first, first + count) of one material, at most 256, that are stored together. They
// lie in one part of the scene and answer to light alike, and so do any 2^k of them from a
// multiple of 2^k on, counted from the first.
struct VertexCluster {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t material = 0;

    friend bool operator==(const VertexCluster&, const VertexCluster&) = default;
};

// A vertex that shares an edge with another.
struct VertexNeighbour {
    std::uint32_t vertex = 0;
    float distance = 0;  // along the edge
};

// How a surface was made.
struct RefinementReport {
    std::size_t scene_triangles = 0;
    std::size_t dropped_triangles = 0;    // without area, or where another lies
    std::size_t two_sided_triangles = 0;  // of the scene, which enclose nothing
    std::size_t start_vertices = 0;       // before any edge was split
    std::uint64_t probes = 0;             // places whose light was looked at
    std::uint64_t rays = 0;               // that they took
    // What interpolation is off by where it was measured, between the vertices: the relative
    // L2 error over the surface, weighed by area.
    double interpolation_error = 0;
    bool meets_target = false;
};

struct RefinedSurface {
    transport::SurfaceMesh mesh;          // V vertices, clusters' in turn; F triangles
    std::vector<VertexCluster> clusters;  // ascending, without gap
    std::vector<TriangleOrigin> origins;  // [F]
    std::vector<float> areas;  // [V], a third of the triangles around each: sums to the surface

    // Triangles at vertex v: triangles_at[first_triangle_at[v] … first_triangle_at[v + 1]).
    std::vector<std::uint32_t> first_triangle_at;  // [V + 1]
    std::vector<std::uint32_t> triangles_at;       // ascending at each vertex
    // Neighbours of v, likewise: each once, ascending.
    std::vector<std::uint32_t> first_neighbour_of;  // [V + 1]
    std::vector<VertexNeighbour> neighbours;

    RefinementReport report;

    [[nodiscard]] std::size_t vertex_count() const { return mesh.vertex_count(); }
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t vertex) const {
        return std::span(triangles_at)
            .subspan(first_triangle_at[vertex],
                     first_triangle_at[vertex + 1] - first_triangle_at[vertex]);
    }
    [[nodiscard]] std::span<const VertexNeighbour> neighbours_of(std::size_t vertex) const {
        return std::span(neighbours)
            .subspan(first_neighbour_of[vertex],
                     first_neighbour_of[vertex + 1] - first_neighbour_of[vertex]);
    }
};

// Fills `areas`, triangles and neighbours at vertices from the mesh.
void connect(RefinedSurface& surface);

}  // namespace relume::bake
