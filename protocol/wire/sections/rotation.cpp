#include "protocol/wire/sections/rotation.h"

#include <cmath>
#include <numbers>

namespace relume::wire {
namespace {

Imath::Quatd quaternion_about(const Imath::V3d& axis, double degrees) {
    const double half_angle = degrees * std::numbers::pi / 360.0;
    return {std::cos(half_angle), std::sin(half_angle) * axis};
}

}  // namespace

Imath::Quatd quaternion_from_yaw_pitch_roll_degrees(double yaw_degrees,
                                                    double pitch_degrees,
                                                    double roll_degrees) {
    return (quaternion_about({0, 1, 0}, yaw_degrees) *
            quaternion_about({1, 0, 0}, pitch_degrees) *
            quaternion_about({0, 0, 1}, roll_degrees))
        .normalized();
}

}  // namespace relume::wire
