// Where the room's image is looked at from.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

// A pinhole in the world. It looks along −Z where it is to look at its own eye, and takes the
// axis that is farthest from its direction where `up` lies along that.
struct Camera {
    Imath::V3d eye{0, 0, 0};
    Imath::V3d look_at{0, 0, -1};
    Imath::V3d up{0, 1, 0};  // unit
    double fov_degrees = 40;

    friend bool operator==(const Camera&, const Camera&) = default;
};

inline constexpr Range kPosition{-1e12, 1e12};
inline constexpr Range kFieldOfViewDegrees{0.01, 179};

inline constexpr std::array kCameraFields{
    field::triple<&Camera::eye>("eye", kPosition, "where it stands, in the world"),
    field::triple<&Camera::look_at>(
        "look_at", kPosition, "what lies in the middle of the image, in the world"),
    field::direction<&Camera::up>("up", "what points upwards in the image, as near as may be"),
    field::number<&Camera::fov_degrees>("fov_degrees",
                                        kFieldOfViewDegrees,
                                        "the angle between the image's lower and upper edge"),
};

inline constexpr Section<Camera> kCamera{"camera", Stage::view,
                                         "Where the image is looked at from", kCameraFields};

}  // namespace relume::wire
