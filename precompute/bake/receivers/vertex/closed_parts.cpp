#include "precompute/bake/receivers/vertex/closed_parts.h"

#include <Imath/ImathBox.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace relume::bake {
namespace {

// An edge as one triangle runs along it.
struct DirectedEdge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t triangle = 0;
    std::int32_t sense = 0;  // +1 from low to high, else -1

    [[nodiscard]] bool is_along(const DirectedEdge& other) const {
        return low == other.low && high == other.high;
    }
};

std::vector<DirectedEdge> sorted_edges(const PointTriangles& surface) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * surface.triangles.size());
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
        const auto& corners = surface.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[k];
            const std::uint32_t b = corners[(k + 1) % 3];
            edges.push_back({.low = std::min(a, b),
                             .high = std::max(a, b),
                             .triangle = i,
                             .sense = a < b ? 1 : -1});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
    });
    return edges;
}

// Calls visit(group) for the edges that run along the same two points.
template <typename Visit>
void for_each_edge(std::span<const DirectedEdge> edges, Visit visit) {
    for (std::size_t first = 0; first < edges.size();) {
        std::size_t last = first + 1;
        while (last < edges.size() && edges[last].is_along(edges[first])) {
            ++last;
        }
        visit(edges.subspan(first, last - first));
        first = last;
    }
}

// Disjoint sets; a set is named by its smallest member.
class Parts {
  public:
    explicit Parts(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t of(std::uint32_t member) {
        while (parent_[member] != member) {
            parent_[member] = parent_[parent_[member]];
            member = parent_[member];
        }
        return member;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

struct Part {
    bool is_balanced = true;
    double volume = 0;
    double area = 0;
    Imath::Box3d bounds;
    double solid_angle_sr = 0;  // at the eye, of a balanced part that has it in its bounds

    [[nodiscard]] SeenSides seen_sides() const {
        // A sheet that is folded back onto itself is balanced and holds nothing.
        constexpr double kFlattest = 1e-9;
        const bool is_solid =
            is_balanced && std::abs(volume) > kFlattest * area * std::sqrt(area);
        const bool encloses_eye =
            std::abs(solid_angle_sr) > 2 * std::numbers::pi;  // of ±4π or 0
        if (!is_solid || encloses_eye) {
            return SeenSides::both;
        }
        return volume > 0 ? SeenSides::front : SeenSides::back;
    }
};

// Joins triangles of opposite senses two by two, first those that are closest in the order in
// which they are given: solids that touch are mostly given one after the other.
void join_pairs(std::span<const DirectedEdge> edge, Parts& parts) {
    constexpr std::size_t kMost = 16;
    if (edge.size() > kMost) {
        return;
    }
    struct Pair {
        std::uint32_t apart;
        std::size_t first, second;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < edge.size(); ++i) {
        for (std::size_t j = i + 1; j < edge.size(); ++j) {
            if (edge[i].sense != edge[j].sense) {
                pairs.push_back({edge[j].triangle - edge[i].triangle, i, j});
            }
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
        return std::tuple(a.apart, a.first) < std::tuple(b.apart, b.first);
    });
    std::array<bool, kMost> is_joined{};
    for (const auto& [apart, first, second] : pairs) {
        if (!is_joined[first] && !is_joined[second]) {
            parts.join(edge[first].triangle, edge[second].triangle);
            is_joined[first] = is_joined[second] = true;
        }
    }
}

std::array<Imath::V3d, 3> corners_of(const PointTriangles& surface, std::size_t triangle) {
    const auto& [a, b, c] = surface.triangles[triangle];
    return {Imath::V3d(surface.points[a]), Imath::V3d(surface.points[b]),
            Imath::V3d(surface.points[c])};
}

// Signed, of a triangle seen from a point [VanOosterom83].
double solid_angle_sr(const std::array<Imath::V3d, 3>& corners, const Imath::V3d& eye) {
    const Imath::V3d a = corners[0] - eye;
    const Imath::V3d b = corners[1] - eye;
    const Imath::V3d c = corners[2] - eye;
    const double la = a.length();
    const double lb = b.length();
    const double lc = c.length();
    return 2 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

std::vector<Part> measured_parts(const PointTriangles& surface,
                                 std::span<const DirectedEdge> edges,
                                 Parts& parts) {
    std::vector<Part> measured(surface.triangles.size());
    std::vector<std::pair<std::uint32_t, std::int32_t>> senses;  // by part
    for_each_edge(edges, [&](std::span<const DirectedEdge> edge) {
        senses.clear();
        for (const DirectedEdge& one : edge) {
            senses.emplace_back(parts.of(one.triangle), one.sense);
        }
        std::sort(senses.begin(), senses.end());
        std::int32_t sum = 0;
        for (std::size_t i = 0; i < senses.size(); ++i) {
            sum += senses[i].second;
            if (i + 1 == senses.size() || senses[i + 1].first != senses[i].first) {
                measured[senses[i].first].is_balanced &= sum == 0;
                sum = 0;
            }
        }
    });
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
        const std::uint32_t name = parts.of(i);
        Part& part = measured[name];
        const Imath::V3d from(surface.points[surface.triangles[name][0]]);
        const auto [a, b, c] = corners_of(surface, i);
        part.volume += (a - from).dot((b - from).cross(c - from)) / 6;
        part.area += (b - a).cross(c - a).length() / 2;
        for (const Imath::V3d& corner : {a, b, c}) {
            part.bounds.extendBy(corner);
        }
    }
    return measured;
}

}  // namespace

std::vector<SeenSides> seen_sides(const PointTriangles& surface, const Imath::V3f& eye) {
    const std::vector<DirectedEdge> edges = sorted_edges(surface);
    Parts parts(surface.triangles.size());
    for_each_edge(edges, [&](std::span<const DirectedEdge> edge) { join_pairs(edge, parts); });
    std::vector<Part> measured = measured_parts(surface, edges, parts);
    const Imath::V3d viewer(eye);
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
        Part& part = measured[parts.of(i)];
        if (part.is_balanced && part.bounds.intersects(viewer)) {
            part.solid_angle_sr += solid_angle_sr(corners_of(surface, i), viewer);
        }
    }
    std::vector<SeenSides> sides;
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
        sides.push_back(measured[parts.of(i)].seen_sides());
    }
    return sides;
}

}  // namespace relume::bake
