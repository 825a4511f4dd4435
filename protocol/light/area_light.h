// Round area lights at infinity: the cap of all directions within an angle of one direction.
#pragma once

#include "protocol/light/light_cubemap.h"

#include <Imath/ImathVec.h>

namespace relume::light {

struct AreaLight {
    Imath::V3f direction{0, 1, 0};        // towards the light; any non-zero length
    float angular_radius_radians = 0.1F;  // in (0, π/2]
    Imath::V3f radiance{1, 1, 1};

    friend bool operator==(const AreaLight&, const AreaLight&) = default;
};

// 2π(1 − cos α).
[[nodiscard]] double solid_angle_sr(const AreaLight& light);

// Adds the light to the cubemap: exactly radiance × solid angle in all, changing continuously
// as the light moves or grows, also across faces and when it is smaller than a texel.
void add_area_light(const AreaLight& light, LightCubemap& cubemap);

}  // namespace relume::light
