#include "server/view/mesh/surface_edges.h"

#include "server/view/mesh/visible_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relume::view {
namespace {

using transport::SurfaceMesh;
using transport::SurfaceTriangle;

// Normals that differ by less are of one surface that curves.
constexpr float kCosineOfCrease = 0.94F;  // 20 degrees
// Along a plane one over the depth is linear in the image. From one pixel to the next it
// departs from that by a part of itself of less than this, or one surface is in front of the
// other.
constexpr float kStepOfNearness = 0.02F;

Imath::V3f normal_at(const SurfaceMesh& mesh, const SurfacePoint& point) {
    const SurfaceTriangle& triangle = mesh.triangles[point.triangle];
    return (mesh.normals[triangle.vertices[0]] * (1 - point.weight_1 - point.weight_2) +
            mesh.normals[triangle.vertices[1]] * point.weight_1 +
            mesh.normals[triangle.vertices[2]] * point.weight_2)
        .normalized();
}

bool differ(const SurfaceMesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
    if (a.triangle == b.triangle) {
        return false;
    }
    if (a.triangle == kNoTriangle || b.triangle == kNoTriangle) {
        return true;
    }
    return mesh.triangles[a.triangle].material != mesh.triangles[b.triangle].material ||
           normal_at(mesh, a).dot(normal_at(mesh, b)) < kCosineOfCrease;
}

// Of three pixels in line, of which the outer ones are `before` and `after`.
bool is_step(float before, float middle, float after) {
    const float bend = std::abs(before - 2 * middle + after);
    return bend > kStepOfNearness * std::max({before, middle, after});
}

}  // namespace

std::vector<std::uint32_t> pixels_of_edges(const SurfaceMesh& mesh,
                                           std::span<const SurfacePoint> points,
                                           std::span<const float> nearness,
                                           std::uint32_t width,
                                           std::uint32_t height) {
    std::vector<std::uint8_t> is_edge(points.size(), 0);
    // Also of those across a corner: an edge that cuts it off may pass no other's middle.
    const auto differs_from_neighbour = [&](std::uint32_t x, std::uint32_t y) {
        for (std::uint32_t v = y - (y > 0 ? 1 : 0); v <= std::min(y + 1, height - 1); ++v) {
            for (std::uint32_t u = x - (x > 0 ? 1 : 0); u <= std::min(x + 1, width - 1); ++u) {
                if (differ(mesh, points[std::size_t{y} * width + x],
                           points[std::size_t{v} * width + u])) {
                    return true;
                }
            }
        }
        return false;
    };
    const auto mark_row = [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t pixel = std::size_t{y} * width + x;
            const auto steps_between = [&](std::size_t before, std::size_t after) {
                return points[pixel].triangle != kNoTriangle &&
                       is_step(nearness[before], nearness[pixel], nearness[after]);
            };
            is_edge[pixel] =
                differs_from_neighbour(x, y) ||
                (x > 0 && x + 1 < width && steps_between(pixel - 1, pixel + 1)) ||
                (y > 0 && y + 1 < height && steps_between(pixel - width, pixel + width));
        }
    };
    tbb::parallel_for(std::uint32_t{0}, height, mark_row);
    std::vector<std::uint32_t> pixels;
    for (std::size_t pixel = 0; pixel < is_edge.size(); ++pixel) {
        if (is_edge[pixel] != 0) {
            pixels.push_back(static_cast<std::uint32_t>(pixel));
        }
    }
    return pixels;
}

}  // namespace relume::view
