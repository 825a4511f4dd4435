// How environment and blend are turned.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

struct Rotation {
    Imath::Quatd quaternion;  // unit; world direction = quaternion · source direction

    friend bool operator==(const Rotation&, const Rotation&) = default;
};

// R = R_y(yaw) · R_x(pitch) · R_z(roll), as a unit quaternion.
[[nodiscard]] Imath::Quatd quaternion_from_yaw_pitch_roll_degrees(double yaw_degrees,
                                                                  double pitch_degrees,
                                                                  double roll_degrees);

inline constexpr std::array kRotationFields{
    field::quaternion<&Rotation::quaternion>(
        "quaternion", "R; world direction = R · source direction; lights are not turned"),
};

inline constexpr Range kAngleDegrees{-1e6, 1e6};
// In the order of quaternion_from_yaw_pitch_roll_degrees.
inline constexpr std::array kRotationAngles{
    FieldRule{"yaw_degrees", FieldKind::number, "about +Y, taken last: R = R_y·R_x·R_z",
              kAngleDegrees},
    FieldRule{"pitch_degrees", FieldKind::number, "about +X", kAngleDegrees},
    FieldRule{"roll_degrees", FieldKind::number, "about +Z, taken first", kAngleDegrees},
};

inline constexpr Section<Rotation> kRotation{
    "rotation",
    Stage::signal,
    "How environment and blend are turned",
    kRotationFields,
    {kRotationAngles, [](std::span<const double> degrees) {
         return Rotation{
             quaternion_from_yaw_pitch_roll_degrees(degrees[0], degrees[1], degrees[2])};
     }}};

}  // namespace relume::wire
