// Where the texels of a map lie on the sphere, by layout. Internal to protocol/light.
#pragma once

#include "protocol/basis/cubemap.h"
#include "protocol/light/environment_map.h"

#include <Imath/ImathVec.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace relume::light {

// A place in a map: x to the right and y down in [0, 1] over the image, or over one face where
// the layout has faces (`face` is 0 elsewhere).
struct MapPoint {
    std::uint32_t face = 0;
    float x = 0;
    float y = 0;
};

[[nodiscard]] inline std::uint32_t face_count(EnvironmentMap::Layout layout) {
    return layout == EnvironmentMap::Layout::cube_faces ? basis::kFaceCount : 1;
}

// Source direction, of any length; formulas in protocol/README.md §1.
[[nodiscard]] Imath::V3f direction_from_map_point(EnvironmentMap::Layout layout,
                                                  const MapPoint& point);
// `direction` may have any non-zero length.
[[nodiscard]] MapPoint map_point_from_direction(EnvironmentMap::Layout layout,
                                                const Imath::V3f& direction);

// Solid angle per unit of x·y at a point. Zero where an angular map shows nothing.
[[nodiscard]] float solid_angle_density_sr(EnvironmentMap::Layout layout, float x, float y);

// Angle that the side of one texel spans where texels are largest (along y for lat-long).
[[nodiscard]] inline float texel_side_radians(EnvironmentMap::Layout layout,
                                              std::uint32_t height) {
    switch (layout) {
        case EnvironmentMap::Layout::lat_long:
            return std::numbers::pi_v<float> / static_cast<float>(height);
        case EnvironmentMap::Layout::angular:
            return 2 * std::numbers::pi_v<float> / static_cast<float>(height);
        case EnvironmentMap::Layout::cube_faces:
            break;
    }
    return 2 / static_cast<float>(height);
}

}  // namespace relume::light
