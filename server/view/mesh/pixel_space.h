// Where things lie in an image, seen through a pinhole.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::view {

// A pinhole in the frame of the scene. Right, up and forward are orthonormal: right × up =
// −forward.
struct Pinhole {
    Imath::V3d eye{0, 0, 0};
    Imath::V3d right{1, 0, 0};
    Imath::V3d up{0, 1, 0};
    Imath::V3d forward{0, 0, -1};
    double tan_half_width = 1;
    double tan_half_height = 1;

    friend bool operator==(const Pinhole&, const Pinhole&) = default;
};

// Homogeneous pixel coordinates: a position with (X, Y, Z) in this space is seen at the image
// point (X/Z, Y/Z), x to the right and y downwards, the centre of the first pixel at (0.5,
// 0.5). Z is its depth along forward; it is positive in front of the eye. Nothing here divides,
// so positions beside and behind the eye have coordinates as others do.
class PixelSpace {
  public:
    PixelSpace(const Pinhole& pinhole, std::uint32_t width, std::uint32_t height)
        : eye_(pinhole.eye),
          x_((pinhole.right / pinhole.tan_half_width + pinhole.forward) * (0.5 * width)),
          y_((pinhole.forward - pinhole.up / pinhole.tan_half_height) * (0.5 * height)),
          z_(pinhole.forward) {}

    [[nodiscard]] Imath::V3d from_position(const Imath::V3f& position) const {
        const Imath::V3d from_eye = Imath::V3d(position) - eye_;
        return {x_.dot(from_eye), y_.dot(from_eye), z_.dot(from_eye)};
    }

  private:
    Imath::V3d eye_;
    Imath::V3d x_;
    Imath::V3d y_;
    Imath::V3d z_;
};

}  // namespace relume::view
