#include "precompute/bake/receivers/vertex/probe_points.h"

#include "precompute/bake/receivers/vertex/vertex_places.h"

#include <Imath/ImathBox.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace relume::bake {
namespace {

// Just off the surface, as offset_origin has it.
Imath::V3f off_surface(const Imath::V3f& position, const StartTriangle& triangle) {
    return position + triangle.face_normal * (triangle.reach * 0x1p-19F);
}

Imath::V2f interpolated(const std::array<Imath::V2f, 3>& corners, const Imath::V2f& weights) {
    return corners[0] * (1 - weights.x - weights.y) + corners[1] * weights.x +
           corners[2] * weights.y;
}

}  // namespace

ProbePoints::ProbePoints(const SplitMesh& mesh) : mesh_(mesh) {
    constexpr float kFarthest = 1e-3F;  // of the diagonal of the scene
    Imath::Box3f bounds;
    for (const Imath::V3f& point : mesh.points()) {
        bounds.extendBy(point);
    }
    farthest_ = kFarthest * bounds.size().length();

    first_triangle_at_.assign(mesh.vertices().size() + 1, 0);
    for (const auto& triangle : mesh.triangles()) {
        for (const std::uint32_t vertex : triangle.vertices) {
            ++first_triangle_at_[vertex];
        }
    }
    std::exclusive_scan(first_triangle_at_.begin(), first_triangle_at_.end(),
                        first_triangle_at_.begin(), std::uint32_t{0});
    triangles_at_.resize(3 * mesh.triangles().size());
    std::vector<std::uint32_t> next = first_triangle_at_;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        for (const std::uint32_t vertex : mesh.triangles()[i].vertices) {
            triangles_at_[next[vertex]++] = i;
        }
    }
}

void ProbePoints::spread_origins(std::span<const Sector> sectors, ProbePoint& point) const {
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        const Sector& sector = sectors[lane * sectors.size() / kPacketSize];
        // Lanes of one sector lie side by side across it, clear of its edges.
        constexpr float kFromEdge = 0.125F;
        const auto part =
            (static_cast<float>(lane * sectors.size() % kPacketSize) + 0.5F) / kPacketSize;
        const float along = kFromEdge + (1 - 2 * kFromEdge) * part;
        const Imath::V3f inwards =
            (sector.from + (sector.to - sector.from) * along - point.position) * kPlaceInset;
        const float length = inwards.length();
        const Imath::V3f step = length > farthest_ ? inwards * (farthest_ / length) : inwards;
        const std::uint32_t start = mesh_.triangles()[sector.triangle].start;
        point.origins[lane] =
            off_surface(point.position + step, mesh_.start().triangles[start]);
    }
}

ProbePoint ProbePoints::at_start_vertex(std::uint32_t vertex) const {
    const StartVertex& start = mesh_.vertices()[vertex];
    ProbePoint point{
        .position = mesh_.position(vertex), .normal = start.normal, .material = start.material};
    std::vector<Sector> sectors;
    for (std::uint32_t i = first_triangle_at_[vertex]; i < first_triangle_at_[vertex + 1];
         ++i) {
        const auto& corners = mesh_.triangles()[triangles_at_[i]].vertices;
        const auto at = static_cast<std::size_t>(
            std::find(corners.begin(), corners.end(), vertex) - corners.begin());
        sectors.push_back({.triangle = triangles_at_[i],
                           .from = mesh_.position(corners[(at + 1) % 3]),
                           .to = mesh_.position(corners[(at + 2) % 3])});
    }
    spread_origins(sectors, point);
    return point;
}

ProbePoint ProbePoints::in_chord(std::uint32_t chord) const {
    const SplitMesh::Chord& along = mesh_.chords()[chord];
    ProbePoint point{.material = mesh_.vertices()[along.vertices[0]].material};
    std::vector<Sector> sectors;
    for (const std::uint32_t triangle : mesh_.edges()[along.edge].triangles) {
        const SplitMesh::Triangle& at = mesh_.triangles()[triangle];
        const auto corner = static_cast<std::size_t>(
            std::find(at.chords.begin(), at.chords.end(), chord) - at.chords.begin());
        if (corner == at.chords.size()) {
            continue;  // of another chord
        }
        if (sectors.empty()) {
            const Imath::V2f middle =
                (at.barycentrics[corner] + at.barycentrics[(corner + 1) % 3]) * 0.5F;
            point.position = mesh_.position_at(at.start, middle);
            point.normal = mesh_.normal_at(at.start, middle);
        }
        // Half way to the ends, so that what is looked at is the middle.
        const Imath::V3f apex = mesh_.position(at.vertices[(corner + 2) % 3]);
        sectors.push_back(
            {.triangle = triangle,
             .from = (apex + mesh_.position(at.vertices[corner])) * 0.5F,
             .to = (apex + mesh_.position(at.vertices[(corner + 1) % 3])) * 0.5F});
    }
    spread_origins(sectors, point);
    return point;
}

ProbePoint ProbePoints::in_triangle(std::uint32_t triangle,
                                    const Imath::V2f& corner_weights) const {
    const SplitMesh::Triangle& at = mesh_.triangles()[triangle];
    const Imath::V2f barycentric = interpolated(at.barycentrics, corner_weights);
    ProbePoint point{.position = mesh_.position_at(at.start, barycentric),
                     .normal = mesh_.normal_at(at.start, barycentric),
                     .material = mesh_.vertices()[at.vertices[0]].material};
    point.origins.fill(off_surface(point.position, mesh_.start().triangles[at.start]));
    return point;
}

}  // namespace relume::bake
