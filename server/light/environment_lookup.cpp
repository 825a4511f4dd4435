// What a pixel that looks past the scene sees: EnvironmentMap::radiance.
#include "server/light/environment_map.h"
#include "server/light/map_geometry.h"
#include "server/light/padded_cubemap.h"

#include <algorithm>
#include <array>
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

// Between two texels a row and two rows; `texel` is the upper left one of four that lie inside.
Imath::V3f mix_inside(const float* texel, std::size_t row_floats, float fx, float fy) {
    // The fourth number is the next texel's and not used: four at a time are a vector.
    std::array<float, 4> mixed;
    for (std::size_t c = 0; c < mixed.size(); ++c) {
        const float* lower = texel + row_floats;
        const float along_upper = texel[c] * (1 - fx) + texel[c + 3] * fx;
        const float along_lower = lower[c] * (1 - fx) + lower[c + 3] * fx;
        mixed[c] = along_upper * (1 - fy) + along_lower * fy;
    }
    return {mixed[0], mixed[1], mixed[2]};
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
    // One texel more than is needed to the right, for the fourth number.
    if (ix >= 0 && iy >= 0 && ix + 2 < static_cast<int>(level.width) &&
        iy + 1 < static_cast<int>(level.height)) {
        const std::size_t row_floats = std::size_t{3} * level.width;
        const std::size_t row =
            std::size_t{point.face} * level.height + static_cast<std::size_t>(iy);
        return mix_inside(&level.rgb[row * row_floats + 3 * static_cast<std::size_t>(ix)],
                          row_floats, fx, fy);
    }
    const auto texel = [&](int dx, int dy) {
        return texel_at(layout, level, point.face, ix + dx, iy + dy);
    };
    const Imath::V3f upper = texel(0, 0) * (1 - fx) + texel(1, 0) * fx;
    const Imath::V3f lower = texel(0, 1) * (1 - fx) + texel(1, 1) * fx;
    return upper * (1 - fy) + lower * fy;
}

// Pixels asked for before their turn: a turned row crosses the map at any slope, which no
// prefetcher of the processor follows.
constexpr std::size_t kLooksAhead = 8;
void prefetch(const Level& level, const MapPoint& point) {
    const auto place = [](float part, std::uint32_t count) {
        const float at = part * static_cast<float>(count) - 0.5F;
        return static_cast<std::size_t>(std::clamp(at, 0.0F, static_cast<float>(count - 1)));
    };
    const std::size_t row =
        std::size_t{point.face} * level.height + place(point.y, level.height);
    const float* texel = &level.rgb[3 * (row * level.width + place(point.x, level.width))];
    __builtin_prefetch(texel);
    __builtin_prefetch(texel + std::size_t{3} * level.width);
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

struct EnvironmentMap::LookPoints {
    LatLongPoints places;
    std::array<std::uint32_t, kLooksPerRun> faces{};
};

void EnvironmentMap::find_points(const LookDirections& directions,
                                 std::size_t count,
                                 LookPoints& points) const {
    if (layout_ == Layout::lat_long) {
        lat_long_points(directions, count, points.places);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
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
    find_points(source_directions, radiances.size(), points);
    LookNumbers levels;
    footprint_levels(footprints_sr, texel_side_radians(layout_, levels_.front().height),
                     levels);
    const auto point_at = [&](std::size_t i) {
        return MapPoint{
            .face = points.faces[i], .x = points.places.x[i], .y = points.places.y[i]};
    };
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        const std::size_t ahead = std::min(i + kLooksAhead, radiances.size() - 1);
        prefetch(levels_[blend_for(levels[ahead], levels_.size()).finer], point_at(ahead));
        const MapPoint point = point_at(i);
        if (footprints_sr[i] <= 0) {
            radiances[i] = bilinear(layout_, levels_.front(), point);
            continue;
        }
        const float footprint_side = std::sqrt(footprints_sr[i]);
        const LevelBlend blend = blend_for(levels[i], levels_.size());
        const auto lookup = [&](const Level& at) {
            return layout_ == Layout::lat_long
                       ? lat_long_lookup(at, point, points.places.cos_latitude[i],
                                         footprint_side)
                       : bilinear(layout_, at, point);
        };
        radiances[i] = lookup(levels_[blend.finer]);
        if (blend.coarser_share > 0) {
            radiances[i] = radiances[i] * (1 - blend.coarser_share) +
                           lookup(levels_[blend.finer + 1]) * blend.coarser_share;
        }
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
