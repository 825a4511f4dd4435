#include "tests/stability/open_plane.h"

#include "tests/stability/test_light.h"

#include <cmath>
#include <numbers>

namespace relume::stability {

OpenPlane::OpenPlane(Workbench& workbench)
    : scene_(workbench.baked("plane", {.width = 32, .height = 32, .face_resolution = 16})),
      session_(scene_->workspace(), {}) {}

std::uint32_t OpenPlane::face_resolution() const {
    return scene_->face_resolution();
}

double OpenPlane::brightness(const light::LightCubemap& cubemap) {
    session_.set_target(lighting_from_cubemap(cubemap));
    run_until_exact(session_);
    double sum = 0;
    const RelitImage image = image_of(*scene_, session_);
    for (const float value : image.rgb) {
        sum += double{value};
    }
    return sum / static_cast<double>(image.rgb.size());
}

double OpenPlane::expected_brightness(const light::AreaLight& light) {
    const double cosine = double{light.direction.normalized().y};
    return double{light.radiance.x} * light::solid_angle_sr(light) * cosine / std::numbers::pi;
}

double OpenPlane::tolerance(const Imath::V3f& direction) const {
    constexpr double kStorage = 0.01;
    const double cosine = double{direction.normalized().y};
    const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
    return tangent * std::numbers::sqrt2 / static_cast<double>(scene_->face_resolution()) +
           kStorage;
}

}  // namespace relume::stability
