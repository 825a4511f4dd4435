// Lights that provoke: one bright disc over a dim sky.
#pragma once

#include "protocol/light/light_rig.h"
#include "tests/stability/relit_image.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace relume::stability {

// Haar coefficients of the rig's radiance.
[[nodiscard]] Lighting lighting_from_rig(const light::LightRig& rig,
                                         std::uint32_t face_resolution);
[[nodiscard]] Lighting lighting_from_cubemap(const light::LightCubemap& cubemap);

// Every texel of this radiance.
[[nodiscard]] light::LightCubemap constant_sky(std::uint32_t face_resolution, float radiance);
// The environment turned about the vertical, by so much from image to image.
[[nodiscard]] std::vector<Lighting> turning_environment(
    std::shared_ptr<const light::PrefilteredEnvironment> environment,
    float degrees_per_image,
    std::size_t images);
// A sky with a disc of light in it.
[[nodiscard]] Lighting sky_and_disc(std::uint32_t face_resolution,
                                    float sky_radiance,
                                    const light::AreaLight& disc);
// What not to do: all energy of the light in the one texel that holds its middle, which gets
// the light's radiance whatever its size.
[[nodiscard]] light::LightCubemap point_sampled(std::uint32_t face_resolution,
                                                const light::AreaLight& light);

// A direction from −Z towards +X, above the horizon.
[[nodiscard]] Imath::V3f direction_from_degrees(float azimuth, float elevation);
[[nodiscard]] float radians_from_degrees(float degrees);

}  // namespace relume::stability
