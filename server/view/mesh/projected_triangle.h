// A triangle as it lies in the image.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <optional>

namespace relume::view {

// [Olano97]: in homogeneous pixel coordinates the ray through the image point (x, y) is d = (x,
// y, 1), and a corner's weight where the ray meets the triangle's plane is proportional to d ·
// (the cross product of the other two corners). This *edge function* is linear in x and y, and
// needs no clipping at the eye. The triangle is hit where all three are at least zero. Two
// triangles that share an edge have edge functions there that differ in nothing but their sign,
// also after rounding, so that no point between them is missed.
struct EdgeFunction {
    double x = 0;
    double y = 0;
    double constant = 0;

    [[nodiscard]] double at(double at_x, double at_y) const {
        return x * at_x + (y * at_y + constant);
    }
};

struct ProjectedTriangle {
    std::array<EdgeFunction, 3> edges;  // of each corner's weight, in the order of corners
    // Times the sum of the weights: one over the depth along forward.
    double nearness_of_weight = 0;
    // No point of the image outside of these is hit.
    double left = 0;
    double right = 0;
    double top = 0;
    double bottom = 0;
    std::uint32_t triangle = 0;
};

// Nothing if no point of an image of this size can show the triangle's front. Corners
// (PixelSpace) are counter-clockwise as seen from the front.
[[nodiscard]] std::optional<ProjectedTriangle> project(const std::array<Imath::V3d, 3>& corners,
                                                       double width,
                                                       double height);

}  // namespace relume::view
