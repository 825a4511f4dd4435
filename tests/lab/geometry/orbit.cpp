#include "tests/lab/geometry/orbit.h"

#include <cmath>
#include <numbers>

namespace relume::lab {

view::Look orbited(const view::Look& from, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const auto turned = [&](const Imath::V3d& v) {
        return Imath::V3d(v.x * cosine + v.z * sine, v.y, v.z * cosine - v.x * sine);
    };
    view::Look look = from;
    look.eye = from.look_at + turned(from.eye - from.look_at);
    look.up = turned(from.up);
    return look;
}

}  // namespace relume::lab
