#include "precompute/bake/receivers/vertex/finished_surface.h"

#include "precompute/bake/receivers/vertex/cluster_order.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace relume::bake {
namespace {

// Texture coordinates of a mesh as the base colour is looked up; none where it has none.
std::span<const Imath::V2f> uvs_of(const scene::Scene& scene, const scene::Mesh& mesh) {
    const auto& texture = scene.materials[mesh.material].base_texture;
    return mesh.uv_set(texture ? texture->uv_set : 0);
}

TriangleOrigin origin_of(const StartTriangle& start, const SplitMesh::Triangle& triangle) {
    TriangleOrigin origin{
        .mesh = start.mesh, .triangle = start.triangle, .is_behind = start.is_behind};
    for (std::size_t k = 0; k < 3; ++k) {
        const Imath::V2f& weights = triangle.barycentrics[k];
        origin.barycentrics[k] = start.is_behind ? Imath::V2f(weights.y, weights.x) : weights;
    }
    return origin;
}

Imath::V2f uv_at(std::span<const Imath::V2f> uvs,
                 const scene::Triangle& triangle,
                 const Imath::V2f& barycentric) {
    if (uvs.empty()) {
        return {0, 0};
    }
    return uvs[triangle[0]] * (1 - barycentric.x - barycentric.y) +
           uvs[triangle[1]] * barycentric.x + uvs[triangle[2]] * barycentric.y;
}

// Texture coordinates of all corners, those of one vertex that are equal once.
void add_uvs(const scene::Scene& scene, RefinedSurface& surface) {
    struct Corner {
        std::uint32_t vertex;
        Imath::V2f uv;
        std::uint32_t triangle;
        std::uint32_t number;
    };
    std::vector<Corner> corners;
    for (std::uint32_t i = 0; i < surface.origins.size(); ++i) {
        const TriangleOrigin& origin = surface.origins[i];
        const scene::Mesh& mesh = scene.meshes[origin.mesh];
        for (std::uint32_t k = 0; k < 3; ++k) {
            corners.push_back({.vertex = surface.mesh.triangles[i].vertices[k],
                               .uv = uv_at(uvs_of(scene, mesh), mesh.triangles[origin.triangle],
                                           origin.barycentrics[k]),
                               .triangle = i,
                               .number = k});
        }
    }
    const auto key = [](const Corner& corner) {
        return std::tuple(corner.vertex, corner.uv.x, corner.uv.y, corner.triangle);
    };
    std::sort(corners.begin(), corners.end(),
              [&](const Corner& a, const Corner& b) { return key(a) < key(b); });
    auto& uvs = surface.mesh.uvs;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& corner = corners[i];
        if (i == 0 || corner.vertex != corners[i - 1].vertex || corner.uv != uvs.back()) {
            uvs.push_back(corner.uv);
        }
        surface.mesh.triangles[corner.triangle].uvs[corner.number] =
            static_cast<std::uint32_t>(uvs.size() - 1);
    }
}

}  // namespace

RefinedSurface finished_surface(const scene::Scene& scene, const SplitMesh& mesh, Rows rows) {
    const std::size_t count = mesh.vertices().size();
    std::vector<Imath::V3f> positions(count);
    std::vector<Imath::V3f> normals(count);
    std::vector<std::uint32_t> materials(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        positions[i] = mesh.position(i);
        normals[i] = mesh.vertices()[i].normal;
        materials[i] = mesh.vertices()[i].material;
    }
    ClusterOrder order = cluster_order({positions, normals, materials, rows});

    RefinedSurface surface;
    surface.clusters = std::move(order.clusters);
    std::vector<std::uint32_t> new_from_old(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t old = order.old_from_new[i];
        new_from_old[old] = i;
        surface.mesh.positions.push_back(positions[old]);
        surface.mesh.normals.push_back(normals[old]);
    }
    // Triangles in the order of their lowest vertices, so that a view reads what lies close.
    struct Place {
        std::array<std::uint32_t, 3> vertices;
        std::uint32_t triangle;
    };
    std::vector<Place> places;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        Place place{.vertices = {}, .triangle = i};
        std::transform(mesh.triangles()[i].vertices.begin(), mesh.triangles()[i].vertices.end(),
                       place.vertices.begin(),
                       [&](std::uint32_t vertex) { return new_from_old[vertex]; });
        places.push_back(place);
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::pair(*std::min_element(a.vertices.begin(), a.vertices.end()), a.triangle) <
               std::pair(*std::min_element(b.vertices.begin(), b.vertices.end()), b.triangle);
    });
    for (const auto& [vertices, i] : places) {
        const SplitMesh::Triangle& triangle = mesh.triangles()[i];
        const StartTriangle& start = mesh.start().triangles[triangle.start];
        surface.mesh.triangles.push_back(
            {.vertices = vertices, .material = scene.meshes[start.mesh].material});
        surface.origins.push_back(origin_of(start, triangle));
    }
    add_uvs(scene, surface);
    connect(surface);
    surface.report.scene_triangles = scene.triangle_count();
    surface.report.dropped_triangles = mesh.start().dropped_triangles;
    surface.report.two_sided_triangles = mesh.start().two_sided_triangles;
    surface.report.start_vertices = mesh.start().vertices.size();
    return surface;
}

}  // namespace relume::bake
