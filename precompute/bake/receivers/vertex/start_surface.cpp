#include "precompute/bake/receivers/vertex/start_surface.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/receivers/vertex/closed_parts.h"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace relume::bake {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
// Normals that differ by less, a quarter of a degree, are one.
constexpr float kSameNormalCosine = 1 - 1e-5F;
// Below this height, relative to its longest edge, a triangle has no area.
constexpr double kFlattest = 1e-8;

using PointTriangle = std::array<std::uint32_t, 3>;

// Points of the scene's vertices, mesh by mesh.
struct WeldedPoints {
    std::vector<Imath::V3f> points;
    std::vector<std::uint32_t> point_from_vertex;  // kNone where no triangle has the vertex
    std::vector<std::size_t> first_vertex_of_mesh;
};

std::tuple<float, float, float> sorting_key(const Imath::V3f& p) {
    return {p.x, p.y, p.z};  // −0 and 0 are equal
}

std::vector<std::uint32_t> used_vertices(const scene::Scene& scene,
                                         const std::vector<std::size_t>& first) {
    std::vector<std::uint8_t> is_used(scene.vertex_count());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        for (const scene::Triangle& triangle : scene.meshes[m].triangles) {
            for (const std::uint32_t vertex : triangle) {
                is_used[first[m] + vertex] = 1;
            }
        }
    }
    std::vector<std::uint32_t> used;
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        if (is_used[i] != 0) {
            used.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return used;
}

WeldedPoints welded_points(const scene::Scene& scene) {
    WeldedPoints welded;
    std::vector<Imath::V3f> positions;
    for (const scene::Mesh& mesh : scene.meshes) {
        welded.first_vertex_of_mesh.push_back(positions.size());
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    }
    std::vector<std::uint32_t> order = used_vertices(scene, welded.first_vertex_of_mesh);
    tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(sorting_key(positions[a]), a) <
               std::tuple(sorting_key(positions[b]), b);
    });
    welded.point_from_vertex.assign(positions.size(), kNone);
    for (const std::uint32_t vertex : order) {
        if (welded.points.empty() || welded.points.back() != positions[vertex]) {
            welded.points.push_back(positions[vertex]);
        }
        welded.point_from_vertex[vertex] = static_cast<std::uint32_t>(welded.points.size() - 1);
    }
    return welded;
}

// That refinement takes.
std::size_t megabytes(std::size_t vertices) {
    return (vertices * kSurfaceBytesPerVertex + 999'999) / 1'000'000;
}

void check_size(const scene::Scene& scene, std::size_t points, std::size_t most_vertices) {
    if (points > most_vertices) {
        throw BakeError(fmt::format(
            "scene '{}' has vertices at {} places, expected at most {}, as many as the surface "
            "may have; allow more vertices, at about {} MB for all of these, or simplify the "
            "scene",
            scene.name, points, most_vertices, megabytes(points)));
    }
    if (scene.triangle_count() > kMostTrianglesPerVertex * most_vertices) {
        throw BakeError(fmt::format(
            "scene '{}' has {} triangles, expected at most {}, which is {} for each of the {} "
            "vertices that the surface may have; allow more vertices or simplify the scene",
            scene.name, scene.triangle_count(), kMostTrianglesPerVertex * most_vertices,
            kMostTrianglesPerVertex, most_vertices));
    }
}

// A triangle of the scene that has area.
struct KeptTriangle {
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
};

struct KeptTriangles {
    std::vector<KeptTriangle> places;
    std::vector<PointTriangle> corners;  // points
};

bool has_area(const std::vector<Imath::V3f>& points, const PointTriangle& corners) {
    const Imath::V3d a(points[corners[0]]);
    const Imath::V3d b(points[corners[1]]);
    const Imath::V3d c(points[corners[2]]);
    const double longest2 = std::max({(b - a).length2(), (c - b).length2(), (a - c).length2()});
    return (b - a).cross(c - a).length() > kFlattest * longest2;
}

KeptTriangles triangles_with_area(const scene::Scene& scene, const WeldedPoints& welded) {
    KeptTriangles kept;
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
        const std::size_t first = welded.first_vertex_of_mesh[m];
        for (std::uint32_t i = 0; i < scene.meshes[m].triangles.size(); ++i) {
            const auto& [a, b, c] = scene.meshes[m].triangles[i];
            const PointTriangle corners{welded.point_from_vertex[first + a],
                                        welded.point_from_vertex[first + b],
                                        welded.point_from_vertex[first + c]};
            if (has_area(welded.points, corners)) {
                kept.places.push_back({.mesh = m, .triangle = i});
                kept.corners.push_back(corners);
            }
        }
    }
    return kept;
}

// Of triangles with the same three points the first stays, whichever way they run.
void drop_doubles(KeptTriangles& kept) {
    std::vector<std::pair<PointTriangle, std::uint32_t>> keys;
    keys.reserve(kept.corners.size());
    for (std::uint32_t i = 0; i < kept.corners.size(); ++i) {
        keys.emplace_back(kept.corners[i], i);
        std::sort(keys.back().first.begin(), keys.back().first.end());
    }
    tbb::parallel_sort(keys.begin(), keys.end());
    std::vector<std::uint8_t> is_double(kept.corners.size());
    for (std::size_t i = 1; i < keys.size(); ++i) {
        is_double[keys[i].second] = keys[i].first == keys[i - 1].first ? 1 : 0;
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < is_double.size(); ++i) {
        if (is_double[i] == 0) {
            kept.places[next] = kept.places[i];
            kept.corners[next++] = kept.corners[i];
        }
    }
    kept.places.resize(next);
    kept.corners.resize(next);
}

Imath::V3f largest_coordinates(const Imath::V3f& p) {
    return {std::abs(p.x), std::abs(p.y), std::abs(p.z)};
}

class Welder {
  public:
    Welder(const scene::Scene& scene, std::vector<Imath::V3f> points)
        : scene_(scene), newest_at_(points.size(), kNone) {
        surface_.points = std::move(points);
    }

    void add(const KeptTriangle& place, const PointTriangle& points, bool is_behind) {
        StartTriangle triangle{
            .mesh = place.mesh, .triangle = place.triangle, .is_behind = is_behind};
        const Imath::V3d a(surface_.points[points[0]]);
        const Imath::V3d cross = (Imath::V3d(surface_.points[points[1]]) - a)
                                     .cross(Imath::V3d(surface_.points[points[2]]) - a);
        triangle.face_normal = Imath::V3f(cross.normalized()) * (is_behind ? -1.0F : 1.0F);
        for (const std::uint32_t point : points) {
            const Imath::V3f size = largest_coordinates(surface_.points[point]);
            triangle.reach = std::max({triangle.reach, size.x, size.y, size.z});
        }
        constexpr std::array<std::size_t, 3> kFront{0, 1, 2};
        constexpr std::array<std::size_t, 3> kBehind{0, 2, 1};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = (is_behind ? kBehind : kFront)[k];
            triangle.vertices[k] = vertex_of(triangle, points[corner], corner);
        }
        surface_.triangles.push_back(triangle);
    }

    [[nodiscard]] StartSurface take() && { return std::move(surface_); }

  private:
    [[nodiscard]] Imath::V3f normal_of(const StartTriangle& triangle,
                                       std::uint32_t scene_vertex) const {
        const scene::Mesh& mesh = scene_.meshes[triangle.mesh];
        if (mesh.normals.empty()) {
            return triangle.face_normal;
        }
        const Imath::V3f& normal = mesh.normals[scene_vertex];
        const float length = normal.length();
        if (!(length > 1e-3F && length < 1e3F)) {
            return triangle.face_normal;
        }
        return normal / (normal.dot(triangle.face_normal) < 0 ? -length : length);
    }

    // The vertex of a corner, which is joined to one that is there already where it can be.
    std::uint32_t vertex_of(const StartTriangle& triangle,
                            std::uint32_t point,
                            std::size_t corner) {
        const scene::Mesh& mesh = scene_.meshes[triangle.mesh];
        const std::uint32_t scene_vertex = mesh.triangles[triangle.triangle][corner];
        const Imath::V3f normal = normal_of(triangle, scene_vertex);
        const Imath::V3f colour =
            mesh.colours.empty() ? Imath::V3f(1, 1, 1) : mesh.colours[scene_vertex];
        for (std::uint32_t at = newest_at_[point]; at != kNone; at = older_[at]) {
            const StartVertex& vertex = surface_.vertices[at];
            if (vertex.material == mesh.material && colours_[at] == colour &&
                vertex.normal.dot(normal) >= kSameNormalCosine) {
                return at;
            }
        }
        surface_.vertices.push_back(
            {.point = point, .material = mesh.material, .normal = normal});
        colours_.push_back(colour);
        older_.push_back(newest_at_[point]);
        newest_at_[point] = static_cast<std::uint32_t>(surface_.vertices.size() - 1);
        return newest_at_[point];
    }

    const scene::Scene& scene_;
    StartSurface surface_;
    // The vertices at a point: the newest, and which was there before.
    std::vector<std::uint32_t> newest_at_;
    std::vector<std::uint32_t> older_;
    std::vector<Imath::V3f> colours_;
};

}  // namespace

StartSurface start_surface(const scene::Scene& scene, std::size_t most_vertices) {
    WeldedPoints welded = welded_points(scene);
    check_size(scene, welded.points.size(), most_vertices);
    KeptTriangles kept = triangles_with_area(scene, welded);
    drop_doubles(kept);
    if (kept.corners.empty()) {
        throw BakeError(fmt::format("scene '{}' has {} triangles and none of them has area",
                                    scene.name, scene.triangle_count()));
    }
    const std::vector<SeenSides> sides =
        seen_sides({welded.points, kept.corners}, scene.camera.eye);
    Welder welder(scene, std::move(welded.points));
    std::size_t two_sided = 0;
    for (std::size_t i = 0; i < kept.corners.size(); ++i) {
        const bool has_holes =
            scene.materials[scene.meshes[kept.places[i].mesh].material].has_holes();
        const SeenSides seen = has_holes ? SeenSides::both : sides[i];
        if (seen != SeenSides::back) {
            welder.add(kept.places[i], kept.corners[i], false);
        }
        if (seen != SeenSides::front) {
            welder.add(kept.places[i], kept.corners[i], true);
        }
        two_sided += seen == SeenSides::both ? 1 : 0;
    }
    StartSurface surface = std::move(welder).take();
    if (surface.vertices.size() > most_vertices) {
        throw BakeError(fmt::format(
            "the surface of scene '{}' has {} vertices before any edge is split, expected at "
            "most {}; allow more vertices, at about {} MB for all of these, or simplify the "
            "scene",
            scene.name, surface.vertices.size(), most_vertices,
            megabytes(surface.vertices.size())));
    }
    surface.dropped_triangles = scene.triangle_count() - kept.corners.size();
    surface.two_sided_triangles = two_sided;
    return surface;
}

}  // namespace relume::bake
