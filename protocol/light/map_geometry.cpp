#include "protocol/light/map_geometry.h"

#include <algorithm>

namespace relume::light {

using Layout = EnvironmentMap::Layout;

namespace {
constexpr float kPi = std::numbers::pi_v<float>;
}

Imath::V3f direction_from_map_point(Layout layout, const MapPoint& point) {
    switch (layout) {
        case Layout::lat_long: {
            const float phi = 2 * kPi * (point.x - 0.5F);
            const float theta = kPi * (0.5F - point.y);
            const float c = std::cos(theta);
            return {std::sin(phi) * c, std::sin(theta), -std::cos(phi) * c};
        }
        case Layout::angular: {
            const float u = 2 * point.x - 1;
            const float v = 1 - 2 * point.y;
            const float r = std::hypot(u, v);
            if (r == 0) {
                return {0, 0, -1};
            }
            const float s = std::sin(kPi * r) / r;
            return {s * u, s * v, -std::cos(kPi * r)};
        }
        case Layout::cube_faces:
            break;
    }
    return basis::cube_point_from_face_point({.face = static_cast<basis::Face>(point.face),
                                              .u = 2 * point.x - 1,
                                              .v = 2 * point.y - 1});
}

MapPoint map_point_from_direction(Layout layout, const Imath::V3f& d) {
    switch (layout) {
        case Layout::lat_long: {
            const float phi = std::atan2(d.x, -d.z);
            const float theta = std::atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z));
            return {.face = 0, .x = phi / (2 * kPi) + 0.5F, .y = 0.5F - theta / kPi};
        }
        case Layout::angular: {
            const float side = std::sqrt(d.x * d.x + d.y * d.y);
            const float r = std::atan2(side, -d.z) / kPi;
            // Straight backwards every point of the rim is the same; take the right one.
            const float u = side > 0 ? d.x / side : 1;
            const float v = side > 0 ? d.y / side : 0;
            return {.face = 0, .x = (1 + r * u) / 2, .y = (1 - r * v) / 2};
        }
        case Layout::cube_faces:
            break;
    }
    const basis::FacePoint point = basis::face_point_from_direction(d);
    return {.face = static_cast<std::uint32_t>(point.face),
            .x = (point.u + 1) / 2,
            .y = (point.v + 1) / 2};
}

float solid_angle_density_sr(Layout layout, float x, float y) {
    switch (layout) {
        case Layout::lat_long:
            return 2 * kPi * kPi * std::max(0.0F, std::cos(kPi * (0.5F - y)));
        case Layout::angular: {
            const float u = 2 * x - 1;
            const float v = 2 * y - 1;
            const float r = std::sqrt(u * u + v * v);
            if (r >= 1) {
                return 0;
            }
            // dω = sin(πr)·π dr dφ and dx dy = r dr dφ / 4.
            return r < 1e-4F ? 4 * kPi * kPi : 4 * kPi * std::sin(kPi * r) / r;
        }
        case Layout::cube_faces:
            break;
    }
    const float u = 2 * x - 1;
    const float v = 2 * y - 1;
    const float s = 1 + u * u + v * v;
    return 4 / (s * std::sqrt(s));
}

}  // namespace relume::light
