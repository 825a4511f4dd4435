#include "tests/unit/view/mesh/rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::view {

using transport::SurfaceMesh;

Pinhole pinhole_at(const Imath::V3d& eye, const Imath::V3d& look_at, double fov_degrees) {
    Pinhole pinhole{.eye = eye};
    pinhole.forward = (look_at - eye).normalized();
    const Imath::V3d up =
        std::abs(pinhole.forward.y) > 0.99 ? Imath::V3d(0, 0, 1) : Imath::V3d(0, 1, 0);
    pinhole.right = pinhole.forward.cross(up).normalized();
    pinhole.up = pinhole.right.cross(pinhole.forward);
    pinhole.tan_half_height = std::tan(fov_degrees * std::numbers::pi / 360);
    pinhole.tan_half_width = pinhole.tan_half_height;
    return pinhole;
}

Imath::V3d ray_through(const Pinhole& pinhole, double x, double y, double side) {
    return pinhole.forward + pinhole.right * ((2 * x / side - 1) * pinhole.tan_half_width) +
           pinhole.up * ((1 - 2 * y / side) * pinhole.tan_half_height);
}

Hit nearest_front(const SurfaceMesh& mesh,
                  const Imath::V3d& eye,
                  const Imath::V3d& ray,
                  const std::function<bool(const Hit&)>& is_solid) {
    Hit best;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& vertices = mesh.triangles[i].vertices;
        const Imath::V3d a(mesh.positions[vertices[0]]);
        const Imath::V3d e1 = Imath::V3d(mesh.positions[vertices[1]]) - a;
        const Imath::V3d e2 = Imath::V3d(mesh.positions[vertices[2]]) - a;
        const Imath::V3d p = ray.cross(e2);
        const double determinant = e1.dot(p);
        if (determinant <= 0) {
            continue;  // its back, or its edge
        }
        const Imath::V3d s = eye - a;
        const double u = s.dot(p) / determinant;
        const Imath::V3d q = s.cross(e1);
        const double v = ray.dot(q) / determinant;
        const double depth = e2.dot(q) / determinant;
        const double margin = std::min({u, v, 1 - u - v});
        const Hit hit{static_cast<std::uint32_t>(i), depth, margin, u, v};
        if (margin >= 0 && depth > 0 && depth < best.depth && (!is_solid || is_solid(hit))) {
            best = hit;
        }
    }
    return best;
}

Imath::V3d position_of(const SurfaceMesh& mesh, const SurfacePoint& point) {
    const auto& vertices = mesh.triangles[point.triangle].vertices;
    const double w1 = point.weight_1;
    const double w2 = point.weight_2;
    return Imath::V3d(mesh.positions[vertices[0]]) * (1 - w1 - w2) +
           Imath::V3d(mesh.positions[vertices[1]]) * w1 +
           Imath::V3d(mesh.positions[vertices[2]]) * w2;
}

}  // namespace relume::view
