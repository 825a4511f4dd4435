// What a pixel that looks past the scene sees: EnvironmentMap::radiance.
#include "server/light/environment_map.h"
#include "server/light/map_geometry.h"
#include "server/light/padded_cubemap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::light {

using Layout = EnvironmentMap::Layout;
using Level = EnvironmentMap::Level;

namespace {

constexpr int kMaxTapsAtPole = 16;

Imath::V3f stored_texel(const Level& level, std::uint32_t face, int x, int y) {
    const std::size_t row = std::size_t{face} * level.height + static_cast<std::size_t>(y);
    const float* texel = &level.rgb[(row * level.width + static_cast<std::size_t>(x)) * 3];
    return {texel[0], texel[1], texel[2]};
}

// A texel just past the border of a face, taken from the face that lies there. At a corner
// three faces meet and there is none: the mean of the three makes all of them agree at the
// point.
Imath::V3f texel_across_edge(const Level& level, std::uint32_t face, int x, int y) {
    const int side = static_cast<int>(level.width);
    const bool x_outside = x < 0 || x >= side;
    const bool y_outside = y < 0 || y >= side;
    const int inner_x = std::clamp(x, 0, side - 1);
    const int inner_y = std::clamp(y, 0, side - 1);
    if (x_outside && y_outside) {
        return (stored_texel(level, face, inner_x, inner_y) +
                texel_across_edge(level, face, x, inner_y) +
                texel_across_edge(level, face, inner_x, y)) /
               3.0F;
    }
    const basis::Texel there =
        texel_past_edge(level.width, static_cast<basis::Face>(face), y, x);
    return stored_texel(level, static_cast<std::uint32_t>(there.face),
                        static_cast<int>(there.column), static_cast<int>(there.row));
}

// x in [-1, width], y in [-1, height].
Imath::V3f texel_at(Layout layout, const Level& level, std::uint32_t face, int x, int y) {
    const int width = static_cast<int>(level.width);
    const int height = static_cast<int>(level.height);
    switch (layout) {
        case Layout::lat_long:
            if (y < 0 || y >= height) {  // over the pole and down the other side
                y = std::clamp(y, 0, height - 1);
                x += width / 2;
            }
            return stored_texel(level, 0, ((x % width) + width) % width, y);
        case Layout::angular:
            return stored_texel(level, 0, std::clamp(x, 0, width - 1),
                                std::clamp(y, 0, height - 1));
        case Layout::cube_faces:
            break;
    }
    if (x < 0 || x >= width || y < 0 || y >= height) {
        return texel_across_edge(level, face, x, y);
    }
    return stored_texel(level, face, x, y);
}

Imath::V3f bilinear(Layout layout, const Level& level, const MapPoint& point) {
    const float x = point.x * static_cast<float>(level.width) - 0.5F;
    const float y = point.y * static_cast<float>(level.height) - 0.5F;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const float fx = x - left;
    const float fy = y - top;
    const int ix = static_cast<int>(left);
    const int iy = static_cast<int>(top);
    const auto mix = [&](const auto& texel) {
        const Imath::V3f upper = texel(0, 0) * (1 - fx) + texel(1, 0) * fx;
        const Imath::V3f lower = texel(0, 1) * (1 - fx) + texel(1, 1) * fx;
        return upper * (1 - fy) + lower * fy;
    };
    if (ix >= 0 && iy >= 0 && ix + 1 < static_cast<int>(level.width) &&
        iy + 1 < static_cast<int>(level.height)) {
        return mix(
            [&](int dx, int dy) { return stored_texel(level, point.face, ix + dx, iy + dy); });
    }
    return mix(
        [&](int dx, int dy) { return texel_at(layout, level, point.face, ix + dx, iy + dy); });
}

// Towards the poles the texels of a lat-long map become narrow, and one pixel spans many of
// them side by side.
Imath::V3f lat_long_lookup(const Level& level,
                           const MapPoint& point,
                           float cos_latitude,
                           float footprint_side) {
    const float full_turn = 2 * std::numbers::pi_v<float>;
    const float span =
        std::min(1.0F, footprint_side / std::max(full_turn * cos_latitude, 1e-6F));
    const float texels = span * static_cast<float>(level.width);
    const int taps = std::clamp(static_cast<int>(std::ceil(texels)), 1, kMaxTapsAtPole);
    if (taps == 1) {
        return bilinear(Layout::lat_long, level, point);
    }
    Imath::V3f sum(0);
    for (int tap = 0; tap < taps; ++tap) {
        const float offset =
            ((static_cast<float>(tap) + 0.5F) / static_cast<float>(taps) - 0.5F);
        float x = point.x + offset * span;
        x -= std::floor(x);
        sum += bilinear(Layout::lat_long, level, {.face = 0, .x = x, .y = point.y});
    }
    return sum / static_cast<float>(taps);
}

}  // namespace

Imath::V3f EnvironmentMap::radiance(const Imath::V3f& source_direction,
                                    float footprint_sr) const {
    const MapPoint point = map_point_from_direction(layout_, source_direction);
    if (footprint_sr <= 0) {
        return bilinear(layout_, levels_.front(), point);
    }
    const float footprint_side = std::sqrt(footprint_sr);
    const float texel_side = texel_side_radians(layout_, levels_.front().height);
    const float finest = std::log2(footprint_side / texel_side);
    const float level = std::clamp(finest, 0.0F, static_cast<float>(levels_.size() - 1));
    const auto lower = static_cast<std::size_t>(level);
    const float fraction = level - static_cast<float>(lower);
    const Imath::V3f& d = source_direction;
    const float cos_latitude = std::sqrt((d.x * d.x + d.z * d.z) / d.dot(d));
    const auto lookup = [&](const Level& at) {
        return layout_ == Layout::lat_long
                   ? lat_long_lookup(at, point, cos_latitude, footprint_side)
                   : bilinear(layout_, at, point);
    };
    if (fraction == 0) {
        return lookup(levels_[lower]);
    }
    return lookup(levels_[lower]) * (1 - fraction) + lookup(levels_[lower + 1]) * fraction;
}

}  // namespace relume::light
