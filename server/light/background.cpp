#include "server/light/background.h"

#include "server/light/disc_coverage.h"

#include <cmath>

namespace relume::light {

Background::Background(const LightRig& rig)
    : environment_(rig.environment),
      blend_(rig.blend),
      source_from_world_(rig.rotation.normalized().toMatrix33().transposed()),
      lights_(rig.lights) {
    const float amount = blend_ ? rig.blend_amount : 0.0F;
    environment_scale_ = (1 - amount) * rig.environment_scale;
    blend_scale_ = amount * rig.environment_scale;
    if (amount <= 0) {
        blend_ = nullptr;
    }
    if (amount >= 1) {
        environment_ = nullptr;
    }
    for (AreaLight& light : lights_) {
        light.direction.normalize();
    }
}

Imath::V3f Background::radiance(const Imath::V3f& world_direction, float footprint_sr) const {
    const Imath::V3f source_direction = world_direction * source_from_world_;
    Imath::V3f sum(0);
    if (environment_) {
        sum += environment_scale_ *
               environment_->source().radiance(source_direction, footprint_sr);
    }
    if (blend_) {
        sum += blend_scale_ * blend_->source().radiance(source_direction, footprint_sr);
    }
    if (lights_.empty()) {
        return sum;
    }
    const Imath::V3f direction = world_direction.normalized();
    constexpr float kSharpestEdge = 1e-5F;
    const float edge = std::max(std::sqrt(footprint_sr), kSharpestEdge);
    for (const AreaLight& light : lights_) {
        const DiscCoverage disc(chord_from_angle(light.angular_radius_radians), edge);
        const float coverage = disc.at((direction - light.direction).length());
        if (coverage > 0) {
            sum += light.radiance * coverage;
        }
    }
    return sum;
}

Imath::V3f background_radiance(const LightRig& rig,
                               const Imath::V3f& world_direction,
                               float footprint_sr) {
    return Background(rig).radiance(world_direction, footprint_sr);
}

}  // namespace relume::light
