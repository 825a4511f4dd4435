#include "precompute/bake/receivers/vertex/vertex_places.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relume::bake {
namespace {

// A triangle as the vertex sees it: its corners from the vertex on.
struct Sector {
    std::uint32_t triangle = 0;
    std::array<std::size_t, 3> corners{};
    float angle = 0;  // at the vertex, radians
};

Sector sector_of(const RefinedSurface& surface, std::uint32_t triangle, std::size_t vertex) {
    const auto& vertices = surface.mesh.triangles[triangle].vertices;
    const auto first = static_cast<std::size_t>(
        std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin());
    Sector sector{.triangle = triangle, .corners = {first, (first + 1) % 3, (first + 2) % 3}};
    const Imath::V3f& at = surface.mesh.positions[vertices[sector.corners[0]]];
    const Imath::V3f a = surface.mesh.positions[vertices[sector.corners[1]]] - at;
    const Imath::V3f b = surface.mesh.positions[vertices[sector.corners[2]]] - at;
    sector.angle = std::atan2(a.cross(b).length(), a.dot(b));
    return sector;
}

// `along` in [0, 1] goes from the sector's first edge to its second.
SurfacePlace place_in(const RefinedSurface& surface, const Sector& sector, float along) {
    constexpr float kFromEdge = 0.125F;
    const float second = std::clamp(along, kFromEdge, 1 - kFromEdge);
    const TriangleOrigin& origin = surface.origins[sector.triangle];
    const auto& corners = origin.barycentrics;
    return {.mesh = origin.mesh,
            .triangle = origin.triangle,
            .is_behind = origin.is_behind,
            .barycentric = corners[sector.corners[0]] * (1 - kPlaceInset) +
                           corners[sector.corners[1]] * (kPlaceInset * (1 - second)) +
                           corners[sector.corners[2]] * (kPlaceInset * second)};
}

}  // namespace

std::array<SurfacePlace, kPacketSize> places_of_vertex(const RefinedSurface& surface,
                                                       std::size_t vertex) {
    std::vector<Sector> sectors;
    float around = 0;
    for (const std::uint32_t triangle : surface.triangles_of(vertex)) {
        sectors.push_back(sector_of(surface, triangle, vertex));
        around += sectors.back().angle;
    }
    // Numbers of a packet's lanes with their bits reversed.
    constexpr std::array<std::uint32_t, kPacketSize> kReversed{0, 8, 4, 12, 2, 10, 6, 14,
                                                               1, 9, 5, 13, 3, 11, 7, 15};
    std::array<SurfacePlace, kPacketSize> places;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        float left = around * (static_cast<float>(kReversed[lane]) + 0.5F) / kPacketSize;
        std::size_t at = 0;
        while (at + 1 < sectors.size() && left >= sectors[at].angle) {
            left -= sectors[at++].angle;
        }
        const float angle = sectors[at].angle;
        places[lane] = place_in(surface, sectors[at], angle > 0 ? left / angle : 0.5F);
    }
    return places;
}

scene::SurfacePoint surface_point_at(const scene::Scene& scene, const SurfacePlace& place) {
    const scene::Mesh& mesh = scene.meshes[place.mesh];
    const auto& [a, b, c] = mesh.triangles[place.triangle];
    const Imath::V3f& p = mesh.positions[a];
    const Imath::V3f front = (mesh.positions[b] - p).cross(mesh.positions[c] - p);
    return scene::surface_point(scene, place.mesh, place.triangle, place.barycentric,
                                place.is_behind ? front : -front);
}

}  // namespace relume::bake
