#include "server/view/mesh/pinhole_from_look.h"

#include <cmath>
#include <numbers>

namespace relume::view {
namespace {

// Unit, of vectors of any length that is not zero.
Imath::V3d unit(const Imath::V3d& vector) {
    const double largest =
        std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
    return (vector / largest).normalized();
}

Imath::V3d axis_farthest_from(const Imath::V3d& direction) {
    const double x = std::abs(direction.x);
    const double y = std::abs(direction.y);
    const double z = std::abs(direction.z);
    if (y <= x && y <= z) {
        return {0, 1, 0};
    }
    return z <= x ? Imath::V3d(0, 0, 1) : Imath::V3d(1, 0, 0);
}

}  // namespace

Pinhole pinhole_from_look(const Look& look, const transport::FrameRecord& frame) {
    constexpr double kLeastSine = 1e-6;
    constexpr double kHalfRadiansPerDegree = std::numbers::pi / 360;
    Pinhole pinhole{.eye = (look.eye - frame.origin) / frame.unit};
    const Imath::V3d towards = look.look_at - look.eye;
    pinhole.forward = towards == Imath::V3d(0) ? Imath::V3d(0, 0, -1) : unit(towards);
    Imath::V3d right = pinhole.forward.cross(look.up);
    if (!(right.length() > kLeastSine * look.up.length())) {
        right = pinhole.forward.cross(axis_farthest_from(pinhole.forward));
    }
    pinhole.right = right.normalized();
    pinhole.up = pinhole.right.cross(pinhole.forward);
    pinhole.tan_half_height = std::tan(look.fov_degrees * kHalfRadiansPerDegree);
    pinhole.tan_half_width = pinhole.tan_half_height * look.width / look.height;
    return pinhole;
}

}  // namespace relume::view
