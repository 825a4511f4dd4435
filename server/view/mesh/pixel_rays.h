// Rays through the places of an image, in single precision.
#pragma once

#include "server/view/mesh/pixel_space.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::view {

class PixelRays {
  public:
    PixelRays() = default;
    PixelRays(const Pinhole& pinhole, std::uint32_t width, std::uint32_t height)
        : eye_(pinhole.eye),
          across_(pinhole.right * (2 * pinhole.tan_half_width / width)),
          along_(pinhole.up * (-2 * pinhole.tan_half_height / height)),
          first_(pinhole.forward - pinhole.right * pinhole.tan_half_width +
                 pinhole.up * pinhole.tan_half_height) {}

    // Of depth 1 along forward; x to the right, y downwards, in pixels.
    [[nodiscard]] Imath::V3f direction(double x, double y) const {
        return Imath::V3f(first_ + across_ * x + along_ * y);
    }
    // From one pixel's direction to that of the next one to the right, and below.
    [[nodiscard]] Imath::V3f across() const { return Imath::V3f(across_); }
    [[nodiscard]] Imath::V3f along() const { return Imath::V3f(along_); }
    // From the eye to a position.
    [[nodiscard]] Imath::V3f to(const Imath::V3f& position) const {
        return Imath::V3f(Imath::V3d(position) - eye_);
    }

  private:
    Imath::V3d eye_{0, 0, 0};
    Imath::V3d across_{0, 0, 0};
    Imath::V3d along_{0, 0, 0};
    Imath::V3d first_{0, 0, -1};
};

}  // namespace relume::view
