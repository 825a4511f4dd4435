#include "precompute/bake/receivers/vertex/split_mesh.h"

#include <Imath/ImathBox.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::bake {
namespace {

constexpr std::array<Imath::V2f, 3> kCorners{{{0, 0}, {1, 0}, {0, 1}}};

// The weight of the first corner beside those of the others.
std::array<double, 3> weights_of(const Imath::V2f& barycentric) {
    const double x = barycentric.x;
    const double y = barycentric.y;
    return {1 - x - y, x, y};
}

// The middle of the side from a corner to the next.
Imath::V2f middle_of(const SplitMesh::Triangle& triangle, std::size_t corner) {
    return (triangle.barycentrics[corner] + triangle.barycentrics[(corner + 1) % 3]) * 0.5F;
}

}  // namespace

SplitMesh::SplitMesh(StartSurface start)
    : start_(std::move(start)), points_(start_.points), vertices_(start_.vertices) {
    constexpr double kTurn = 0.1;  // of the surface's diagonal
    Imath::Box3d bounds;
    for (const Imath::V3f& point : points_) {
        bounds.extendBy(Imath::V3d(point));
    }
    turn_length_ = points_.empty() ? 0 : kTurn * bounds.size().length();
    join_start();
}

void SplitMesh::join_start() {
    struct Side {
        std::array<std::uint32_t, 2> points;  // ascending
        std::uint32_t triangle;
        std::uint32_t number;
    };
    std::vector<Side> sides;
    for (std::uint32_t i = 0; i < start_.triangles.size(); ++i) {
        const auto& vertices = start_.triangles[i].vertices;
        triangles_.push_back({.vertices = vertices, .start = i, .barycentrics = kCorners});
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = vertices_[vertices[k]].point;
            const std::uint32_t b = vertices_[vertices[(k + 1) % 3]].point;
            sides.push_back({{std::min(a, b), std::max(a, b)}, i, k});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::pair(a.points, a.triangle) < std::pair(b.points, b.triangle);
    });
    Changes made;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side& side = sides[i];
        if (i == 0 || side.points != sides[i - 1].points) {
            add_edge(side.points[0], side.points[1]);
        }
        const auto edge = static_cast<std::uint32_t>(edges_.size() - 1);
        Triangle& triangle = triangles_[side.triangle];
        triangle.chords[side.number] = chord_of(edge, triangle.vertices[side.number],
                                                triangle.vertices[(side.number + 1) % 3], made);
        edges_[edge].triangles.push_back(side.triangle);
    }
}

void SplitMesh::set_ends(std::uint32_t edge, std::uint32_t point, std::uint32_t other) {
    edges_[edge].points = {point, other};
    edges_[edge].length2 = (Imath::V3d(points_[other]) - Imath::V3d(points_[point])).length2();
}

std::uint32_t SplitMesh::add_edge(std::uint32_t point, std::uint32_t other) {
    edges_.emplace_back();
    const auto edge = static_cast<std::uint32_t>(edges_.size() - 1);
    set_ends(edge, point, other);
    return edge;
}

std::uint32_t SplitMesh::add_chord(std::uint32_t edge,
                                   std::uint32_t vertex,
                                   std::uint32_t other) {
    chords_.push_back({.vertices = {vertex, other}, .edge = edge});
    Edge& of = edges_[edge];
    of.chords.push_back(static_cast<std::uint32_t>(chords_.size() - 1));
    const Imath::V3d turn =
        Imath::V3d(vertices_[other].normal) - Imath::V3d(vertices_[vertex].normal);
    of.turn2 = std::max(of.turn2, turn_length_ * turn_length_ * turn.length2());
    return of.chords.back();
}

std::uint32_t SplitMesh::chord_of(std::uint32_t edge,
                                  std::uint32_t vertex,
                                  std::uint32_t other,
                                  Changes& changes) {
    for (const std::uint32_t chord : edges_[edge].chords) {
        const auto& [a, b] = chords_[chord].vertices;
        if ((a == vertex && b == other) || (a == other && b == vertex)) {
            return chord;
        }
    }
    changes.chords.push_back(add_chord(edge, vertex, other));
    return changes.chords.back();
}

bool SplitMesh::is_longer(std::uint32_t edge, std::uint32_t other) const {
    const auto length2 = [this](std::uint32_t i) {
        return edges_[i].length2 + edges_[i].turn2;
    };
    return std::pair(length2(edge), edge) > std::pair(length2(other), other);
}

std::uint32_t SplitMesh::longest_edge(std::uint32_t triangle) const {
    const auto& chords = triangles_[triangle].chords;
    std::uint32_t longest = chords_[chords[0]].edge;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
        const std::uint32_t edge = chords_[chords[k]].edge;
        longest = is_longer(edge, longest) ? edge : longest;
    }
    return longest;
}

std::uint32_t SplitMesh::edge_to_split(std::uint32_t triangle) const {
    std::uint32_t edge = longest_edge(triangle);
    for (std::size_t i = 0; i < edges_[edge].triangles.size();) {
        const std::uint32_t longest = longest_edge(edges_[edge].triangles[i]);
        ++i;
        if (longest != edge) {  // a longer one: this ends
            edge = longest;
            i = 0;
        }
    }
    return edge;
}

bool SplitMesh::can_split(std::uint32_t edge) const {
    constexpr double kShortest = 0x1p-14;  // of the largest coordinate
    double reach = 0;
    for (const std::uint32_t point : edges_[edge].points) {
        for (int axis = 0; axis < 3; ++axis) {
            reach = std::max(reach, std::abs(static_cast<double>(points_[point][axis])));
        }
    }
    return edges_[edge].length2 > (kShortest * reach) * (kShortest * reach);
}

void SplitMesh::split(std::uint32_t edge, Changes& changes) {
    const Edge old = std::move(edges_[edge]);
    EdgeSplit split{.middle = static_cast<std::uint32_t>(points_.size()),
                    .first_point = old.points[0],
                    .first_made = changes.vertices.size()};
    const Triangle& first = triangles_[old.triangles[0]];
    points_.push_back(
        position_at(first.start, middle_of(first, corner_at(old.triangles[0], edge))));
    // The first half takes the number of the whole. Chords of the whole keep that number too,
    // but no triangle has them in the end.
    edges_[edge] = {};
    set_ends(edge, old.points[0], split.middle);
    split.halves = {edge, add_edge(split.middle, old.points[1])};
    for (const std::uint32_t triangle : old.triangles) {
        cut(triangle, corner_at(triangle, edge), split, changes);
    }
}

// The corner from which a triangle runs along an edge that is whole or is being split.
std::size_t SplitMesh::corner_at(std::uint32_t triangle, std::uint32_t edge) const {
    const auto& chords = triangles_[triangle].chords;
    return static_cast<std::size_t>(
        std::find_if(chords.begin(), chords.end(),
                     [&](std::uint32_t chord) { return chords_[chord].edge == edge; }) -
        chords.begin());
}

std::uint32_t SplitMesh::vertex_in_middle(std::uint32_t triangle,
                                          std::size_t corner,
                                          const EdgeSplit& split,
                                          Changes& changes) {
    const Triangle& at = triangles_[triangle];
    const std::uint32_t chord = at.chords[corner];
    const auto made =
        std::find_if(changes.vertices.begin() + static_cast<std::ptrdiff_t>(split.first_made),
                     changes.vertices.end(),
                     [chord](const Changes::MadeVertex& one) { return one.chord == chord; });
    if (made != changes.vertices.end()) {
        return made->vertex;
    }
    vertices_.push_back({.point = split.middle,
                         .material = vertices_[at.vertices[corner]].material,
                         .normal = normal_at(at.start, middle_of(at, corner))});
    const auto vertex = static_cast<std::uint32_t>(vertices_.size() - 1);
    changes.vertices.push_back({.chord = chord, .vertex = vertex});
    return vertex;
}

std::uint32_t SplitMesh::edge_to_apex(std::uint32_t apex, EdgeSplit& split) {
    for (const std::uint32_t edge : split.to_apexes) {
        if (edges_[edge].points[1] == apex) {
            return edge;
        }
    }
    return split.to_apexes.emplace_back(add_edge(split.middle, apex));
}

void SplitMesh::cut(std::uint32_t triangle,
                    std::size_t corner,
                    EdgeSplit& split,
                    Changes& changes) {
    const std::size_t k1 = (corner + 1) % 3;
    const std::size_t k2 = (corner + 2) % 3;
    const std::uint32_t middle = vertex_in_middle(triangle, corner, split, changes);
    const auto second = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(triangles_[triangle]);
    Triangle& near_a = triangles_[triangle];
    Triangle& near_b = triangles_[second];
    const Imath::V2f barycentric = middle_of(near_a, corner);
    const auto [a, b, c] =
        std::array{near_a.vertices[corner], near_a.vertices[k1], near_a.vertices[k2]};
    const bool a_is_first = vertices_[a].point == split.first_point;
    const std::uint32_t half_a = split.halves[a_is_first ? 0 : 1];
    const std::uint32_t half_b = split.halves[a_is_first ? 1 : 0];
    const std::uint32_t across = edge_to_apex(vertices_[c].point, split);
    const std::uint32_t chord_across = chord_of(across, middle, c, changes);

    near_a.vertices[k1] = middle;
    near_a.barycentrics[k1] = barycentric;
    near_a.chords[corner] = chord_of(half_a, a, middle, changes);
    near_a.chords[k1] = chord_across;
    near_b.vertices[corner] = middle;
    near_b.barycentrics[corner] = barycentric;
    near_b.chords[corner] = chord_of(half_b, middle, b, changes);
    near_b.chords[k2] = chord_across;

    auto& beyond = edges_[chords_[near_b.chords[k1]].edge].triangles;
    std::replace(beyond.begin(), beyond.end(), triangle, second);
    edges_[half_a].triangles.push_back(triangle);
    edges_[half_b].triangles.push_back(second);
    edges_[across].triangles.insert(edges_[across].triangles.end(), {triangle, second});
    changes.triangles.insert(changes.triangles.end(), {triangle, second});
}

Imath::V3f SplitMesh::position_at(std::uint32_t start, const Imath::V2f& barycentric) const {
    const std::array<double, 3> weights = weights_of(barycentric);
    Imath::V3d sum(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        const StartVertex& vertex = start_.vertices[start_.triangles[start].vertices[i]];
        sum += Imath::V3d(start_.points[vertex.point]) * weights[i];
    }
    return Imath::V3f(sum);
}

Imath::V3f SplitMesh::normal_at(std::uint32_t start, const Imath::V2f& barycentric) const {
    const std::array<double, 3> weights = weights_of(barycentric);
    Imath::V3d sum(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        sum += Imath::V3d(start_.vertices[start_.triangles[start].vertices[i]].normal) *
               weights[i];
    }
    const double length = sum.length();
    return length > 1e-3 ? Imath::V3f(sum / length) : start_.triangles[start].face_normal;
}

double SplitMesh::area(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle].vertices;
    const Imath::V3d p(position(a));
    return 0.5 * (Imath::V3d(position(b)) - p).cross(Imath::V3d(position(c)) - p).length();
}

}  // namespace relume::bake
