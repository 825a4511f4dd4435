#include "precompute/bake/receivers/vertex/refined_surface.h"

#include <algorithm>
#include <numeric>

namespace relume::bake {
namespace {

float area_of(const transport::SurfaceMesh& mesh, const transport::SurfaceTriangle& triangle) {
    const auto& [a, b, c] = triangle.vertices;
    const Imath::V3d p(mesh.positions[a]);
    const Imath::V3d cross =
        (Imath::V3d(mesh.positions[b]) - p).cross(Imath::V3d(mesh.positions[c]) - p);
    return static_cast<float>(0.5 * cross.length());
}

// Counts of each vertex to the places where its entries begin.
void sum_up(std::vector<std::uint32_t>& first) {
    std::exclusive_scan(first.begin(), first.end(), first.begin(), std::uint32_t{0});
}

void list_triangles(RefinedSurface& surface) {
    const auto& triangles = surface.mesh.triangles;
    surface.first_triangle_at.assign(surface.vertex_count() + 1, 0);
    for (const auto& triangle : triangles) {
        for (const std::uint32_t vertex : triangle.vertices) {
            ++surface.first_triangle_at[vertex];
        }
    }
    sum_up(surface.first_triangle_at);
    surface.triangles_at.resize(3 * triangles.size());
    std::vector<std::uint32_t> next = surface.first_triangle_at;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t vertex : triangles[i].vertices) {
            surface.triangles_at[next[vertex]++] = i;
        }
    }
}

void list_neighbours(RefinedSurface& surface) {
    surface.first_neighbour_of.assign(1, 0);
    surface.neighbours.clear();
    std::vector<std::uint32_t> around;
    for (std::uint32_t vertex = 0; vertex < surface.vertex_count(); ++vertex) {
        around.clear();
        for (const std::uint32_t triangle : surface.triangles_of(vertex)) {
            const auto& corners = surface.mesh.triangles[triangle].vertices;
            std::copy_if(corners.begin(), corners.end(), std::back_inserter(around),
                         [vertex](std::uint32_t corner) { return corner != vertex; });
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for (const std::uint32_t other : around) {
            surface.neighbours.push_back(
                {.vertex = other,
                 .distance = (surface.mesh.positions[other] - surface.mesh.positions[vertex])
                                 .length()});
        }
        surface.first_neighbour_of.push_back(
            static_cast<std::uint32_t>(surface.neighbours.size()));
    }
}

}  // namespace

void connect(RefinedSurface& surface) {
    surface.areas.assign(surface.vertex_count(), 0);
    for (const auto& triangle : surface.mesh.triangles) {
        const float third = area_of(surface.mesh, triangle) / 3;
        for (const std::uint32_t vertex : triangle.vertices) {
            surface.areas[vertex] += third;
        }
    }
    list_triangles(surface);
    list_neighbours(surface);
}

}  // namespace relume::bake
