#include "tests/stability/test_light.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/cubemap_projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace relume::stability {

Lighting lighting_from_cubemap(const light::LightCubemap& cubemap) {
    const auto haar =
        basis::CubemapProjection::onto(basis::CubemapBasis::haar(cubemap.face_resolution));
    Lighting lighting;
    light::lighting_coefficients(cubemap, *haar, lighting);
    return lighting;
}

Lighting lighting_from_rig(const light::LightRig& rig, std::uint32_t face_resolution) {
    light::LightCubemap cubemap;
    light::evaluate(rig, face_resolution, cubemap);
    return lighting_from_cubemap(cubemap);
}

light::LightCubemap constant_sky(std::uint32_t face_resolution, float radiance) {
    light::LightCubemap cubemap(face_resolution);
    std::fill(cubemap.radiance.begin(), cubemap.radiance.end(), radiance);
    return cubemap;
}

Lighting sky_and_disc(std::uint32_t face_resolution,
                      float sky_radiance,
                      const light::AreaLight& disc) {
    light::LightCubemap cubemap = constant_sky(face_resolution, sky_radiance);
    light::add_area_light(disc, cubemap);
    return lighting_from_cubemap(cubemap);
}

std::vector<Lighting> turning_environment(
    std::shared_ptr<const light::PrefilteredEnvironment> environment,
    float degrees_per_image,
    std::size_t images) {
    light::LightRig rig;
    rig.environment = std::move(environment);
    std::vector<Lighting> lightings;
    for (std::size_t i = 0; i < images; ++i) {
        rig.rotation.setAxisAngle(
            Imath::V3f(0, 1, 0),
            radians_from_degrees(degrees_per_image * static_cast<float>(i)));
        lightings.push_back(lighting_from_rig(rig, rig.environment->face_resolution()));
    }
    return lightings;
}

light::LightCubemap point_sampled(std::uint32_t face_resolution,
                                  const light::AreaLight& light) {
    light::LightCubemap cubemap(face_resolution);
    const basis::Texel texel = basis::texel_from_direction(face_resolution, light.direction);
    const auto planes = cubemap.planes();
    for (std::size_t colour = 0; colour < planes.size(); ++colour) {
        planes[colour][basis::index_from_texel(face_resolution, texel)] =
            light.radiance[static_cast<int>(colour)];
    }
    return cubemap;
}

float radians_from_degrees(float degrees) {
    return degrees * std::numbers::pi_v<float> / 180;
}

Imath::V3f direction_from_degrees(float azimuth, float elevation) {
    const float a = radians_from_degrees(azimuth);
    const float e = radians_from_degrees(elevation);
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

}  // namespace relume::stability
