#include "protocol/light/colour_primaries.h"

#include <cmath>

namespace relume::light {
namespace {

using Imath::M33d;
using Imath::V2d;
using Imath::V3d;

// Of luminance 1. Not finite where y is 0.
V3d xyz_from(const V2d& xy) {
    return {xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y};
}

M33d columns(const V3d& a, const V3d& b, const V3d& c) {
    return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

M33d diagonal(const V3d& v) {
    return {v.x, 0, 0, 0, v.y, 0, 0, 0, v.z};
}

bool is_finite(const M33d& m) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            if (!std::isfinite(m[row][column])) {
                return false;
            }
        }
    }
    return true;
}

// So that white is (1, 1, 1) and has luminance 1.
M33d xyz_from_rgb(const Primaries& primaries) {
    const M33d unscaled =
        columns(xyz_from(primaries.red), xyz_from(primaries.green), xyz_from(primaries.blue));
    return unscaled * diagonal(product(unscaled.inverse(), xyz_from(primaries.white)));
}

M33d adapted(const V2d& from_white, const V2d& to_white) {
    const M33d cones(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296);
    const V3d from = product(cones, xyz_from(from_white));
    const V3d to = product(cones, xyz_from(to_white));
    return cones.inverse() * diagonal(to / from) * cones;
}

}  // namespace

bool is_rec709(const Primaries& primaries) {
    constexpr double kTolerance = 0.002;
    const Primaries rec709;
    const auto near = [](const V2d& a, const V2d& b) {
        return std::abs(a.x - b.x) <= kTolerance && std::abs(a.y - b.y) <= kTolerance;
    };
    return near(primaries.red, rec709.red) && near(primaries.green, rec709.green) &&
           near(primaries.blue, rec709.blue) && near(primaries.white, rec709.white);
}

V3d luminance_weights(const Primaries& primaries) {
    const M33d xyz = xyz_from_rgb(primaries);
    return {xyz[1][0], xyz[1][1], xyz[1][2]};
}

M33d rec709_from_xyz() {
    return xyz_from_rgb(Primaries{}).inverse();
}

std::optional<M33d> rec709_from(const Primaries& primaries) {
    constexpr double kLeastArea = 1e-4;
    const V2d along = primaries.green - primaries.red;
    const V2d across = primaries.blue - primaries.red;
    if (!(std::abs(along.x * across.y - along.y * across.x) > kLeastArea)) {
        return std::nullopt;
    }
    if (!(primaries.red.y != 0 && primaries.green.y != 0 && primaries.blue.y != 0 &&
          primaries.white.y > 0)) {
        return std::nullopt;
    }
    const M33d matrix = rec709_from_xyz() * adapted(primaries.white, Primaries{}.white) *
                        xyz_from_rgb(primaries);
    if (!is_finite(matrix)) {
        return std::nullopt;
    }
    return matrix;
}

}  // namespace relume::light
