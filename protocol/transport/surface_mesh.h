// The triangles between the vertices of a transport of kind `mesh`: what a view draws.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace relume::transport {

// Counter-clockwise seen from the side that its vertices stand for. Only that side is seen: a
// surface with two sides has two triangles, of other vertices.
struct SurfaceTriangle {
    std::array<std::uint32_t, 3> vertices{};  // different from each other
    std::array<std::uint32_t, 3> uvs{};
    std::uint32_t material = 0;

    friend bool operator==(const SurfaceTriangle&, const SurfaceTriangle&) = default;
};

// A vertex is a receiver of the transport and has its number. Where a surface has a crease, a
// border of materials or a second side, several vertices have one position. Corners have
// texture coordinates apart from vertices, so that a seam of a texture is none of the light.
struct SurfaceMesh {
    std::vector<Imath::V3f> positions;  // [V], in the frame of the scene, finite
    std::vector<Imath::V3f> normals;    // [V], unit
    std::vector<Imath::V2f> uvs;        // [U], v upwards, finite
    std::vector<SurfaceTriangle> triangles;

    [[nodiscard]] std::size_t vertex_count() const { return positions.size(); }

    friend bool operator==(const SurfaceMesh&, const SurfaceMesh&) = default;
};

// A vertex's normal may miss unit length by this much.
inline constexpr float kSurfaceNormalTolerance = 1e-3F;

// Throws TransportError naming `file`, what was found and what was expected, unless the mesh is
// as above: counts of 1 … 2³² − 1 and as many normals as positions, all numbers finite, normals
// unit, indices in range, no triangle with a vertex twice.
void check_surface_mesh(const SurfaceMesh& mesh, std::string_view file);

// The content of mesh.bin (protocol/README.md §2). Reading checks that the length is that of
// the counts before anything is allocated, and then the mesh; it throws TransportError. Writing
// expects a mesh that check_surface_mesh takes.
[[nodiscard]] std::vector<std::byte> bytes_from_surface_mesh(const SurfaceMesh& mesh);
[[nodiscard]] SurfaceMesh surface_mesh_from_bytes(std::span<const std::byte> bytes,
                                                  std::string_view file);

// Throws TransportError unless `material_from_vertex` [V] has as many entries as the mesh has
// vertices, and the vertices of every triangle have the triangle's material.
void check_surface_materials(const SurfaceMesh& mesh,
                             std::span<const std::uint32_t> material_from_vertex,
                             std::string_view file);

}  // namespace relume::transport
