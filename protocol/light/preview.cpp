#include "protocol/light/preview.h"

#include "protocol/light/map_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

// Middle grey of the picture.
constexpr double kKey = 0.18;

float luminance(const Imath::V3f& rgb) {
    return 0.2126F * rgb.x + 0.7152F * rgb.y + 0.0722F * rgb.z;
}

float filmic(float x) {
    return std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

std::uint8_t srgb_byte(float linear) {
    const float encoded =
        linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0F, 1.0F)));
}

// Log-average over the sphere of what is not black; a black map needs no exposure.
float exposure_from(const std::vector<Imath::V3f>& pixels, std::uint32_t width) {
    double log_sum = 0;
    double weight_sum = 0;
    const auto height = static_cast<std::uint32_t>(pixels.size() / width);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float y = (static_cast<float>(i / width) + 0.5F) / static_cast<float>(height);
        const double weight = solid_angle_density_sr(EnvironmentMap::Layout::lat_long, 0, y);
        const float value = luminance(pixels[i]);
        if (value > 0) {
            log_sum += weight * std::log(double{value});
            weight_sum += weight;
        }
    }
    return weight_sum > 0 ? static_cast<float>(kKey / std::exp(log_sum / weight_sum)) : 1.0F;
}

}  // namespace

PreviewImage make_preview(const EnvironmentMap& map,
                          std::uint32_t width,
                          std::uint32_t height) {
    constexpr auto kLayout = EnvironmentMap::Layout::lat_long;
    const std::size_t count = std::size_t{width} * height;
    std::vector<Imath::V3f> pixels(count);
    for (std::size_t i = 0; i < count; ++i) {
        const MapPoint point{
            .face = 0,
            .x = (static_cast<float>(i % width) + 0.5F) / static_cast<float>(width),
            .y = (static_cast<float>(i / width) + 0.5F) / static_cast<float>(height)};
        const float footprint_sr =
            solid_angle_density_sr(kLayout, point.x, point.y) / static_cast<float>(count);
        pixels[i] = map.radiance(direction_from_map_point(kLayout, point), footprint_sr);
    }
    const float exposure = exposure_from(pixels, width);
    PreviewImage preview{width, height, {}};
    preview.rgb.reserve(count * 3);
    for (const Imath::V3f& pixel : pixels) {
        for (int c = 0; c < 3; ++c) {
            preview.rgb.push_back(srgb_byte(filmic(exposure * pixel[c])));
        }
    }
    return preview;
}

}  // namespace relume::light
