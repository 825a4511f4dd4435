#include "server/view/mesh/projected_triangle.h"

#include <algorithm>
#include <limits>

namespace relume::view {
namespace {

using Corners = std::array<Imath::V3d, 3>;

// How far, in pixels, rounding may move a bound.
constexpr double kBoundMargin = 1.0 / 256;

// No contraction and no reordering: swapping a and b must change signs alone.
EdgeFunction edge_function(const Imath::V3d& a, const Imath::V3d& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Whether all corners lie beyond one side of the image, or behind the eye.
bool is_outside(const Corners& corners, double width, double height) {
    const auto all = [&corners](const auto& beyond) {
        return beyond(corners[0]) && beyond(corners[1]) && beyond(corners[2]);
    };
    return all([](const Imath::V3d& p) { return p.z <= 0; }) ||
           all([](const Imath::V3d& p) { return p.x < 0; }) ||
           all([](const Imath::V3d& p) { return p.y < 0; }) ||
           all([=](const Imath::V3d& p) { return p.x > width * p.z; }) ||
           all([=](const Imath::V3d& p) { return p.y > height * p.z; });
}

void bound(const Corners& corners, double width, double height, ProjectedTriangle& projected) {
    projected.left = projected.top = 0;
    projected.right = width;
    projected.bottom = height;
    for (const Imath::V3d& corner : corners) {
        if (corner.z <= std::numeric_limits<double>::min()) {
            return;  // the triangle passes the eye: it may show anywhere
        }
    }
    const auto [left, right] =
        std::minmax({corners[0].x / corners[0].z, corners[1].x / corners[1].z,
                     corners[2].x / corners[2].z});
    const auto [top, bottom] =
        std::minmax({corners[0].y / corners[0].z, corners[1].y / corners[1].z,
                     corners[2].y / corners[2].z});
    projected.left = std::max(projected.left, left - kBoundMargin);
    projected.right = std::min(projected.right, right + kBoundMargin);
    projected.top = std::max(projected.top, top - kBoundMargin);
    projected.bottom = std::min(projected.bottom, bottom + kBoundMargin);
}

}  // namespace

std::optional<ProjectedTriangle> project(const Corners& corners, double width, double height) {
    if (is_outside(corners, width, height)) {
        return std::nullopt;
    }
    // Pixel coordinates turn round what the world's are: a front is clockwise in them.
    const EdgeFunction first = edge_function(corners[2], corners[1]);
    const double volume =
        corners[0].x * first.x + corners[0].y * first.y + corners[0].z * first.constant;
    if (!(volume > std::numeric_limits<double>::min())) {
        return std::nullopt;  // its back, or its edge
    }
    ProjectedTriangle projected;
    projected.edges = {first, edge_function(corners[0], corners[2]),
                       edge_function(corners[1], corners[0])};
    projected.nearness_of_weight = 1 / volume;
    bound(corners, width, height, projected);
    return projected;
}

}  // namespace relume::view
