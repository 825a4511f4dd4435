// softbox_studio: rectangular panels around a dark room, each facing the centre.
#include "protocol/light/map_geometry.h"
#include "protocol/light/procedural_environment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::light {
namespace {

// A panel spans |x| ≤ half_width and |y| ≤ half_height of the plane at distance one along
// `towards`, upright (its x axis is horizontal).
struct Panel {
    Imath::V3f towards;
    float half_width;
    float half_height;
    Imath::V3f radiance;
};

const std::array<Panel, 4> kPanels{{
    {{-0.75F, 0.55F, -0.55F}, 0.35F, 0.50F, {14.0F, 13.2F, 12.0F}},  // key, warm
    {{0.95F, 0.25F, -0.20F}, 0.45F, 0.45F, {2.0F, 2.3F, 2.7F}},      // fill, cool
    {{0.35F, 0.35F, 0.90F}, 0.08F, 0.70F, {20.0F, 20.0F, 21.0F}},    // strip behind
    {{0.05F, 1.0F, 0.10F}, 0.55F, 0.40F, {5.0F, 5.0F, 5.0F}},        // ceiling
}};

constexpr float kEdge = 0.02F;

float edge_falloff(float distance_inside) {
    const float t = std::clamp(distance_inside / kEdge + 0.5F, 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

Imath::V3f panel_radiance(const Panel& panel, const Imath::V3f& direction) {
    const Imath::V3f forward = panel.towards.normalized();
    const float along = direction.dot(forward);
    if (along <= 0.1F) {
        return Imath::V3f(0);
    }
    const Imath::V3f right = forward.cross({0, 1, 0}).normalized();
    const Imath::V3f up = right.cross(forward);
    const float x = std::abs(direction.dot(right) / along);
    const float y = std::abs(direction.dot(up) / along);
    // Diffusion cloth: brightest before the lamp.
    const float sheen = 1 - 0.35F * std::min(1.0F, x * x + y * y);
    return panel.radiance *
           (sheen * edge_falloff(panel.half_width - x) * edge_falloff(panel.half_height - y));
}

Imath::V3f studio_radiance(const Imath::V3f& direction) {
    const float height = 0.5F + 0.5F * direction.y;
    Imath::V3f sum =
        Imath::V3f(0.05F, 0.05F, 0.055F) + height * Imath::V3f(0.10F, 0.10F, 0.11F);
    for (const Panel& panel : kPanels) {
        sum += panel_radiance(panel, direction);
    }
    return sum;
}

}  // namespace

EnvironmentMap softbox_studio(std::uint32_t height) {
    MapImage image{2 * height, height, {}};
    image.rgb.resize(std::size_t{image.width} * image.height * 3);
    tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t row) {
        float* out = &image.rgb[std::size_t{row} * image.width * 3];
        for (std::uint32_t column = 0; column < image.width; ++column, out += 3) {
            const Imath::V3f direction = direction_from_map_point(
                EnvironmentMap::Layout::lat_long,
                {.face = 0,
                 .x = (static_cast<float>(column) + 0.5F) / static_cast<float>(image.width),
                 .y = (static_cast<float>(row) + 0.5F) / static_cast<float>(image.height)});
            const Imath::V3f value = studio_radiance(direction);
            std::copy_n(&value.x, 3, out);
        }
    });
    return {std::move(image), Projection::lat_long};
}

}  // namespace relume::light
