// The pinhole camera of an image bake, as protocol/README.md §2 writes it into the manifest.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>
#include <string>

namespace relume::scene {

// Where a camera stands, before the image's shape is known. World units, +Y up.
struct CameraPlacement {
    std::string name{};
    Imath::V3f eye{0, 0, 0};
    Imath::V3f look_at{0, 0, -1};
    Imath::V3f up{0, 1, 0};
    float vertical_fov_degrees = 40;
};

// The ray of pixel (x, y) is
//     forward + (2x/w − 1)·tan_half_width·right + (1 − 2y/h)·tan_half_height·up
// with x, y continuous: the centre of the top left pixel is (0.5, 0.5).
class Camera {
  public:
    // The vertical field of view holds whatever the image's shape. Throws SceneError
    // (bad_camera) where eye and look_at coincide, a number is not finite, the field of view
    // is outside (0, 180) degrees, or an image side is zero. An `up` along the view direction
    // is replaced by the axis farthest from it.
    Camera(const CameraPlacement& placement, std::uint32_t width, std::uint32_t height);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] const Imath::V3f& eye() const { return eye_; }
    // Unit, orthogonal, right-handed: right × up = −forward.
    [[nodiscard]] const Imath::V3f& right() const { return right_; }
    [[nodiscard]] const Imath::V3f& up() const { return up_; }
    [[nodiscard]] const Imath::V3f& forward() const { return forward_; }
    [[nodiscard]] float tan_half_width() const { return tan_half_width_; }
    [[nodiscard]] float tan_half_height() const { return tan_half_height_; }

    // Unit direction through the continuous pixel position (x, y), x in [0, width] to the
    // right, y in [0, height] downwards.
    [[nodiscard]] Imath::V3f direction_from_pixel(float x, float y) const;

  private:
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    Imath::V3f eye_;
    Imath::V3f right_;
    Imath::V3f up_;
    Imath::V3f forward_;
    float tan_half_width_ = 0;
    float tan_half_height_ = 0;
};

}  // namespace relume::scene
