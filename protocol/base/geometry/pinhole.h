// Rays of a pinhole camera, which whoever bakes an image and whoever draws behind it must share.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::geometry {

// Right, up and forward are orthonormal, right-handed: right × up = −forward.
struct Pinhole {
    Imath::V3f right{1, 0, 0};
    Imath::V3f up{0, 1, 0};
    Imath::V3f forward{0, 0, -1};
    float tan_half_width = 1;
    float tan_half_height = 1;

    // Unit direction through the image point (x, y) in pixels, of an image of width×height: x to
    // the right, y downwards, the centre of the top left pixel is (0.5, 0.5).
    [[nodiscard]] Imath::V3f direction_from_pixel(float x,
                                                  float y,
                                                  std::uint32_t width,
                                                  std::uint32_t height) const {
        const float across = (2.0F * x / static_cast<float>(width) - 1.0F) * tan_half_width;
        const float along = (1.0F - 2.0F * y / static_cast<float>(height)) * tan_half_height;
        return (forward + right * across + up * along).normalized();
    }
};

}  // namespace relume::geometry
