// What a pixel that looks past the scene sees: EnvironmentMap::radiance.
#include "server/light/environment_map.h"
#include "server/light/look_kernel.h"
#include "server/light/map_geometry.h"
#include "server/light/padded_cubemap.h"

#include <algorithm>
#include <array>
#include <bit>
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
    const auto texel = [&](int dx, int dy) {
        return texel_at(layout, level, point.face, ix + dx, iy + dy);
    };
    const Imath::V3f upper = texel(0, 0) * (1 - fx) + texel(1, 0) * fx;
    const Imath::V3f lower = texel(0, 1) * (1 - fx) + texel(1, 1) * fx;
    return upper * (1 - fy) + lower * fy;
}

// Towards the poles the texels of a lat-long map become narrow, and one pixel spans many of
// them side by side.
Imath::V3f lat_long_lookup(const Level& level, const MapPoint& point, float span) {
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

// Between which levels of the pyramid a pixel of this size looks.
struct LevelBlend {
    std::size_t finer = 0;
    float coarser_share = 0;
};
LevelBlend blend_for(float wanted_level, std::size_t level_count) {
    if (!(wanted_level > 0)) {
        return {};
    }
    const float level = std::min(wanted_level, static_cast<float>(level_count - 1));
    const auto finer = static_cast<std::size_t>(level);
    return {.finer = finer, .coarser_share = level - static_cast<float>(finer)};
}

}  // namespace

void EnvironmentMap::find_points(const LookDirections& directions,
                                 std::span<const float> footprints_sr,
                                 LookPoints& points) const {
    if (layout_ == Layout::lat_long) {
        constexpr float kFullTurn = 2 * std::numbers::pi_v<float>;
        lat_long_points(directions, footprints_sr.size(), points.places);
        for (std::size_t i = 0; i < footprints_sr.size(); ++i) {
            const float around = std::max(kFullTurn * points.places.cos_latitude[i], 1e-6F);
            points.spans[i] =
                std::min(1.0F, std::sqrt(std::max(footprints_sr[i], 0.0F)) / around);
        }
        return;
    }
    for (std::size_t i = 0; i < footprints_sr.size(); ++i) {
        const MapPoint point = map_point_from_direction(
            layout_, {directions.x[i], directions.y[i], directions.z[i]});
        points.faces[i] = point.face;
        points.places.x[i] = point.x;
        points.places.y[i] = point.y;
    }
}

void EnvironmentMap::radiances(const LookDirections& source_directions,
                               std::span<const float> footprints_sr,
                               std::span<Imath::V3f> radiances) const {
    LookPoints points;
    find_points(source_directions, footprints_sr, points);
    LookNumbers wanted;
    footprint_levels(footprints_sr, texel_side_radians(layout_, levels_.front().height),
                     wanted);
    std::array<LevelBlend, kLooksPerRun> blends;
    std::uint32_t levels_seen = 0;
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        blends[i] = footprints_sr[i] > 0 ? blend_for(wanted[i], levels_.size()) : LevelBlend{};
        levels_seen |= std::uint32_t{1} << blends[i].finer;
        levels_seen |= (blends[i].coarser_share > 0 ? std::uint32_t{2} : 0U) << blends[i].finer;
    }
    std::fill(radiances.begin(), radiances.end(), Imath::V3f(0));
    for (; levels_seen != 0; levels_seen &= levels_seen - 1) {
        const auto level = static_cast<std::size_t>(std::countr_zero(levels_seen));
        LookNumbers weights;
        for (std::size_t i = 0; i < radiances.size(); ++i) {
            const LevelBlend& blend = blends[i];
            weights[i] = blend.finer == level       ? 1 - blend.coarser_share
                         : blend.finer + 1 == level ? blend.coarser_share
                                                    : 0;
        }
        add_level(levels_[level], points, weights, radiances);
    }
}

void EnvironmentMap::add_level(const Level& level,
                               const LookPoints& points,
                               const LookNumbers& weights,
                               std::span<Imath::V3f> radiances) const {
    const LookLevel texels{
        .rgb = level.rgb.data(), .width = level.width, .height = level.height};
    LookTaps taps;
    find_taps(texels, points, radiances.size(), taps);
    add_taps(texels, taps, weights, radiances);
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        if (taps.offsets[i] != LookTaps::kNotInside || weights[i] == 0) {
            continue;
        }
        const MapPoint point{
            .face = points.faces[i], .x = points.places.x[i], .y = points.places.y[i]};
        radiances[i] += weights[i] * (layout_ == Layout::lat_long
                                          ? lat_long_lookup(level, point, points.spans[i])
                                          : bilinear(layout_, level, point));
    }
}

Imath::V3f EnvironmentMap::radiance(const Imath::V3f& source_direction,
                                    float footprint_sr) const {
    LookDirections direction;
    direction.set(0, source_direction.x, source_direction.y, source_direction.z);
    Imath::V3f result;
    radiances(direction, {&footprint_sr, 1}, {&result, 1});
    return result;
}

}  // namespace relume::light
