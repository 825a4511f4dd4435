#include "precompute/scene/camera.h"

#include "precompute/scene/error.h"
#include "protocol/base/geometry/pinhole.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace relume::scene {
namespace {

bool is_finite(const Imath::V3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Imath::V3f axis_farthest_from(const Imath::V3f& direction) {
    const float x = std::abs(direction.x);
    const float y = std::abs(direction.y);
    const float z = std::abs(direction.z);
    if (z <= x && z <= y)
        return {0, 0, 1};
    return y <= x ? Imath::V3f{0, 1, 0} : Imath::V3f{1, 0, 0};
}

[[noreturn]] void refuse(const CameraPlacement& placement, const std::string& why) {
    throw SceneError(SceneFault::bad_camera,
                     fmt::format("camera '{}': {}", placement.name, why));
}

}  // namespace

Camera::Camera(const CameraPlacement& placement, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), eye_(placement.eye) {
    if (!is_finite(placement.eye) || !is_finite(placement.look_at) || !is_finite(placement.up))
        refuse(placement, "eye, look-at and up must be finite numbers");
    if (width == 0 || height == 0)
        refuse(placement,
               fmt::format("image of {}x{} pixels; expected at least 1x1", width, height));
    const float fov = placement.vertical_fov_degrees;
    if (!(fov > 0 && fov < 180))
        refuse(
            placement,
            fmt::format("vertical field of view of {} degrees; expected 0 < fov < 180", fov));
    const Imath::V3f view = placement.look_at - placement.eye;
    if (view.length() == 0)
        refuse(placement, "eye and look-at are the same point");
    forward_ = view.normalized();
    Imath::V3f across = forward_.cross(placement.up.normalized());
    if (across.length() < 1e-5F)
        across = forward_.cross(axis_farthest_from(forward_));
    right_ = across.normalized();
    up_ = right_.cross(forward_).normalized();
    tan_half_height_ = std::tan(fov * std::numbers::pi_v<float> / 360.0F);
    tan_half_width_ = tan_half_height_ * static_cast<float>(width) / static_cast<float>(height);
}

Imath::V3f Camera::direction_from_pixel(float x, float y) const {
    return geometry::Pinhole{right_, up_, forward_, tan_half_width_, tan_half_height_}
        .direction_from_pixel(x, y, width_, height_);
}

}  // namespace relume::scene
