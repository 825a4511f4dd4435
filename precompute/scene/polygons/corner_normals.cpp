#include "precompute/scene/polygons/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace relume::scene {
namespace {

const double kCreaseCosine = std::cos(std::numbers::pi / 3);
// Faces at one place beyond which creases are not looked for, for that takes their square.
constexpr std::size_t kMostFacesAtOnePlace = 512;

struct Use {
    std::uint32_t triangle = 0;
    std::uint32_t corner = 0;  // 0, 1 or 2
};

// For every position the first of those equal to it, so that seams do not show.
std::vector<std::uint32_t> places_of(const std::vector<Imath::V3d>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
        const Imath::V3d& p = positions[i];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return key(a) != key(b) ? key(a) < key(b) : a < b;
    });
    std::vector<std::uint32_t> places(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        places[order[i]] =
            i > 0 && key(order[i]) == key(order[i - 1]) ? places[order[i - 1]] : order[i];
    return places;
}

Imath::V3d unit_or_zero(const Imath::V3d& v) {
    const double length = v.length();
    return length > 0 && std::isfinite(length) ? v / length : Imath::V3d(0, 0, 0);
}

class NormalMaker {
  public:
    NormalMaker(PolygonMesh& mesh, std::vector<CornerTriangle>& triangles)
        : mesh_(mesh), triangles_(triangles) {
        areas_.reserve(triangles.size());
        for (const CornerTriangle& triangle : triangles) {
            const auto at = [&](std::size_t k) {
                return mesh.positions[mesh.corners[triangle.corner[k]].position];
            };
            areas_.push_back((at(1) - at(0)).cross(at(2) - at(0)));
        }
    }

    // The uses of one place, some of which want normals.
    void make(const std::vector<Use>& uses) {
        for (const Use& use : uses) {
            const std::uint32_t old = triangles_[use.triangle].corner[use.corner];
            if (mesh_.corners[old].normal != kNone)
                continue;
            PolygonCorner corner = mesh_.corners[old];
            corner.normal = static_cast<std::uint32_t>(mesh_.normals.size());
            mesh_.normals.emplace_back(normal_of(use, uses));
            made_.push_back({use, corner});
        }
        for (const auto& [use, corner] : made_) {
            triangles_[use.triangle].corner[use.corner] =
                static_cast<std::uint32_t>(mesh_.corners.size());
            mesh_.corners.push_back(corner);
        }
        count_ += made_.size();
        made_.clear();
    }

    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    [[nodiscard]] Imath::V3f normal_of(const Use& use, const std::vector<Use>& uses) const {
        const std::uint32_t polygon = triangles_[use.triangle].polygon;
        const std::uint32_t group = mesh_.polygons[polygon].smoothing;
        const Imath::V3d own = unit_or_zero(areas_[use.triangle]);
        const bool looks_for_creases = uses.size() <= kMostFacesAtOnePlace;
        Imath::V3d sum(0, 0, 0);
        for (const Use& other : uses) {
            const std::uint32_t other_polygon = triangles_[other.triangle].polygon;
            const Imath::V3d& area = areas_[other.triangle];
            bool belongs = other_polygon == polygon;
            if (!belongs && group == smoothing::kByAngle)
                belongs =
                    looks_for_creases && own.dot(unit_or_zero(area)) > kCreaseCosine - 1e-9;
            else if (!belongs && group != smoothing::kFacets)
                belongs = mesh_.polygons[other_polygon].smoothing == group;
            if (belongs)
                sum += area;
        }
        const Imath::V3d mean = unit_or_zero(sum);
        return Imath::V3f(mean == Imath::V3d(0, 0, 0) ? own : mean);
    }

    PolygonMesh& mesh_;
    std::vector<CornerTriangle>& triangles_;
    std::vector<Imath::V3d> areas_;
    std::vector<std::pair<Use, PolygonCorner>> made_;
    std::size_t count_ = 0;
};

}  // namespace

std::size_t add_missing_normals(PolygonMesh& mesh, std::vector<CornerTriangle>& triangles) {
    const bool all_there =
        std::all_of(triangles.begin(), triangles.end(), [&](const CornerTriangle& triangle) {
            return std::all_of(
                triangle.corner.begin(), triangle.corner.end(),
                [&](std::uint32_t c) { return mesh.corners[c].normal != kNone; });
        });
    if (all_there)
        return 0;
    const std::vector<std::uint32_t> places = places_of(mesh.positions);
    // Uses sorted by place: counts, then positions in one list.
    std::vector<std::size_t> starts(mesh.positions.size() + 1, 0);
    const auto place_of = [&](const CornerTriangle& triangle, std::size_t k) {
        return places[mesh.corners[triangle.corner[k]].position];
    };
    for (const CornerTriangle& triangle : triangles) {
        for (std::size_t k = 0; k < 3; ++k)
            ++starts[place_of(triangle, k) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Use> sorted(3 * triangles.size());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (std::uint32_t k = 0; k < 3; ++k)
            sorted[next[place_of(triangles[i], k)]++] = {i, k};
    }
    NormalMaker maker(mesh, triangles);
    std::vector<Use> uses;
    for (std::size_t place = 0; place + 1 < starts.size(); ++place) {
        uses.assign(sorted.begin() + static_cast<std::ptrdiff_t>(starts[place]),
                    sorted.begin() + static_cast<std::ptrdiff_t>(starts[place + 1]));
        maker.make(uses);
    }
    return maker.count();
}

}  // namespace relume::scene
