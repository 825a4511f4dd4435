#include "tests/unit/surface/surface_laws.h"

#include "protocol/transport/surface_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace relume::bake {
namespace {

template <typename Value>
Value interpolated(const std::vector<Value>& values,
                   const scene::Triangle& triangle,
                   const Imath::V2f& at) {
    return values[triangle[0]] * (1 - at.x - at.y) + values[triangle[1]] * at.x +
           values[triangle[2]] * at.y;
}

Imath::V3d cross_of(const Imath::V3f& a, const Imath::V3f& b, const Imath::V3f& c) {
    return (Imath::V3d(b) - Imath::V3d(a)).cross(Imath::V3d(c) - Imath::V3d(a));
}

Imath::V3d cross_of(const std::vector<Imath::V3f>& positions,
                    const std::array<std::uint32_t, 3>& corners) {
    return cross_of(positions[corners[0]], positions[corners[1]], positions[corners[2]]);
}

void expect_clusters(const RefinedSurface& surface) {
    std::vector<std::uint32_t> materials;
    for (const VertexCluster& cluster : surface.clusters) {
        EXPECT_EQ(cluster.first, materials.size());
        EXPECT_GE(cluster.count, 1U);
        EXPECT_LE(cluster.count, 256U);
        materials.insert(materials.end(), cluster.count, cluster.material);
    }
    EXPECT_NO_THROW(transport::check_surface_materials(surface.mesh, materials, "mesh.bin"));
}

void expect_on_scene(const scene::Scene& scene, const RefinedSurface& surface) {
    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, double> areas;
    ASSERT_EQ(surface.origins.size(), surface.mesh.triangles.size());
    for (std::size_t i = 0; i < surface.origins.size(); ++i) {
        const TriangleOrigin& origin = surface.origins[i];
        const transport::SurfaceTriangle& triangle = surface.mesh.triangles[i];
        const scene::Mesh& mesh = scene.meshes[origin.mesh];
        const scene::Triangle& whole = mesh.triangles[origin.triangle];
        EXPECT_EQ(triangle.material, mesh.material);
        for (std::size_t k = 0; k < 3; ++k) {
            const Imath::V2f& at = origin.barycentrics[k];
            const Imath::V3f expected = interpolated(mesh.positions, whole, at);
            const Imath::V3f& found = surface.mesh.positions[triangle.vertices[k]];
            ASSERT_LE((found - expected).length(), 1e-6F * (1 + expected.length()));
            if (!mesh.uvs.empty()) {
                const Imath::V2f uv = interpolated(mesh.uvs, whole, at);
                ASSERT_LE((surface.mesh.uvs[triangle.uvs[k]] - uv).length(), 1e-5F);
            }
        }
        const Imath::V3d front =
            cross_of(mesh.positions, whole) * (origin.is_behind ? -1.0 : 1.0);
        const Imath::V3d cross = cross_of(surface.mesh.positions, triangle.vertices);
        ASSERT_GT(cross.dot(front), 0);
        for (const std::uint32_t vertex : triangle.vertices) {
            ASSERT_GE(Imath::V3d(surface.mesh.normals[vertex]).dot(front), 0);
        }
        areas[{origin.mesh, origin.triangle, origin.is_behind}] += cross.length() / 2;
    }
    for (const auto& [place, area] : areas) {
        const scene::Mesh& mesh = scene.meshes[std::get<0>(place)];
        const double whole =
            cross_of(mesh.positions, mesh.triangles[std::get<1>(place)]).length() / 2;
        EXPECT_NEAR(area, whole, 1e-4 * whole);  // corners are rounded
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    std::size_t sides = 0;
    for (const auto& [place, area] : areas) {
        seen.emplace(std::get<0>(place), std::get<1>(place));
        ++sides;
    }
    EXPECT_EQ(seen.size(), scene.triangle_count() - surface.report.dropped_triangles);
    EXPECT_EQ(sides, seen.size() + surface.report.two_sided_triangles);
}

using Point = std::tuple<float, float, float>;

Point point_of(const RefinedSurface& surface, std::uint32_t vertex) {
    const Imath::V3f& p = surface.mesh.positions[vertex];
    return {p.x, p.y, p.z};
}

}  // namespace

void expect_lawful(const scene::Scene& scene, const RefinedSurface& surface) {
    EXPECT_NO_THROW(transport::check_surface_mesh(surface.mesh, "mesh.bin"));
    EXPECT_TRUE(std::isfinite(surface.report.interpolation_error));
    expect_clusters(surface);
    expect_on_scene(scene, surface);
}

void expect_no_t_junction(const RefinedSurface& surface) {
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& triangle : surface.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.insert({triangle.vertices[k], triangle.vertices[(k + 1) % 3]});
        }
    }
    for (const auto& [a, b] : edges) {
        const Imath::V3f& from = surface.mesh.positions[a];
        const Imath::V3f along = surface.mesh.positions[b] - from;
        const float length2 = along.length2();
        for (std::size_t i = 0; i < surface.vertex_count(); ++i) {
            const Imath::V3f to = surface.mesh.positions[i] - from;
            const float t = to.dot(along) / length2;
            const bool is_within =
                t > 1e-3F && t < 1 - 1e-3F && (to - along * t).length2() < 1e-10F * length2;
            ASSERT_FALSE(is_within) << "vertex " << i << " in edge " << a << "–" << b;
        }
    }
}

void expect_closed(const RefinedSurface& surface) {
    std::map<std::pair<Point, Point>, int> edges;
    for (const auto& triangle : surface.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[{point_of(surface, triangle.vertices[k]),
                     point_of(surface, triangle.vertices[(k + 1) % 3])}];
        }
    }
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        ASSERT_NE(back, edges.end());
        ASSERT_EQ(back->second, count);
    }
}

}  // namespace relume::bake
