// Rays that are traced in the plainest way: what views are compared with.
#pragma once

#include "protocol/transport/surface_mesh.h"
#include "server/view/mesh/pixel_space.h"
#include "server/view/mesh/visible_surface.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <functional>
#include <limits>

namespace relume::view {

// A pinhole with a field of view upwards and a square image.
[[nodiscard]] Pinhole pinhole_at(const Imath::V3d& eye,
                                 const Imath::V3d& look_at,
                                 double fov_degrees);

// Along the ray through a place of a square image, unnormalised: depth along forward is 1.
[[nodiscard]] Imath::V3d ray_through(const Pinhole& pinhole, double x, double y, double side);

struct Hit {
    std::uint32_t triangle = kNoTriangle;
    double depth = std::numeric_limits<double>::infinity();
    double margin = 0;  // of the ray from the triangle's nearest edge, as a weight
    double weight_1 = 0;
    double weight_2 = 0;
};

// Every triangle tried, in double precision [Moller97]; fronts alone, where they are solid.
[[nodiscard]] Hit nearest_front(const transport::SurfaceMesh& mesh,
                                const Imath::V3d& eye,
                                const Imath::V3d& ray,
                                const std::function<bool(const Hit&)>& is_solid = nullptr);

[[nodiscard]] Imath::V3d position_of(const transport::SurfaceMesh& mesh,
                                     const SurfacePoint& point);

}  // namespace relume::view
