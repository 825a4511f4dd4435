#include "protocol/light/background.h"

#include "protocol/light/disc_coverage.h"

#include <algorithm>
#include <array>
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

void Background::radiances(const LookDirections& world_directions,
                           std::span<const float> footprints_sr,
                           std::span<Imath::V3f> radiances) const {
    std::fill(radiances.begin(), radiances.end(), Imath::V3f(0));
    const LookDirections source_directions = rotated(world_directions);
    if (environment_) {
        add_environment(*environment_, environment_scale_, source_directions, footprints_sr,
                        radiances);
    }
    if (blend_) {
        add_environment(*blend_, blend_scale_, source_directions, footprints_sr, radiances);
    }
    for (std::size_t i = 0; !lights_.empty() && i < radiances.size(); ++i) {
        radiances[i] +=
            lights_seen({world_directions.x[i], world_directions.y[i], world_directions.z[i]},
                        footprints_sr[i]);
    }
}

// All of them, for that takes no longer than some.
LookDirections Background::rotated(const LookDirections& world_directions) const {
    const auto& m = source_from_world_.x;
    const auto& [x, y, z] = world_directions;
    LookDirections source_directions;
    for (std::size_t i = 0; i < kLooksPerRun; ++i) {
        source_directions.x[i] = x[i] * m[0][0] + y[i] * m[1][0] + z[i] * m[2][0];
        source_directions.y[i] = x[i] * m[0][1] + y[i] * m[1][1] + z[i] * m[2][1];
        source_directions.z[i] = x[i] * m[0][2] + y[i] * m[1][2] + z[i] * m[2][2];
    }
    return source_directions;
}

void Background::add_environment(const PrefilteredEnvironment& environment,
                                 const Imath::V3f& scale,
                                 const LookDirections& source_directions,
                                 std::span<const float> footprints_sr,
                                 std::span<Imath::V3f> radiances) const {
    std::array<Imath::V3f, kLooksPerRun> seen;
    const std::span<Imath::V3f> wanted = std::span(seen).first(radiances.size());
    environment.source().radiances(source_directions, footprints_sr, wanted);
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        radiances[i] += scale * seen[i];
    }
}

Imath::V3f Background::lights_seen(const Imath::V3f& world_direction,
                                   float footprint_sr) const {
    const Imath::V3f direction = world_direction.normalized();
    constexpr float kSharpestEdge = 1e-5F;
    const float edge = std::max(std::sqrt(footprint_sr), kSharpestEdge);
    Imath::V3f sum(0);
    for (const AreaLight& light : lights_) {
        const DiscCoverage disc(chord_from_angle(light.angular_radius_radians), edge);
        const float coverage = disc.at((direction - light.direction).length());
        if (coverage > 0) {
            sum += light.radiance * coverage;
        }
    }
    return sum;
}

Imath::V3f Background::radiance(const Imath::V3f& world_direction, float footprint_sr) const {
    LookDirections direction;
    direction.set(0, world_direction.x, world_direction.y, world_direction.z);
    Imath::V3f result;
    radiances(direction, {&footprint_sr, 1}, {&result, 1});
    return result;
}

Imath::V3f background_radiance(const LightRig& rig,
                               const Imath::V3f& world_direction,
                               float footprint_sr) {
    return Background(rig).radiance(world_direction, footprint_sr);
}

}  // namespace relume::light
