// What a pixel that looks past the scene sees: EnvironmentMap::radiance.
#include "protocol/light/environment_map.h"
#include "protocol/light/look_kernel.h"
#include "protocol/light/map_geometry.h"
#include "protocol/light/padded_cubemap.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

void EnvironmentMap::find_points(const LookDirections& source_directions,
                                 std::span<const float> footprints_sr,
                                 LookPoints& points) const {
    const LookDirections directions =
        centre_ == MapCentre::negative_z ? source_directions : turned(source_directions);
    if (layout_ == Layout::lat_long) {
        lat_long_points(directions, footprints_sr.size(), points.places);
        footprint_spans(footprints_sr, points.places.cos_latitude, points.spans);
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

// To where a map whose centre looks to −Z has them.
LookDirections EnvironmentMap::turned(const LookDirections& source_directions) const {
    const Imath::M33f map_from_source = turn_of_centre(centre_).transposed();
    LookDirections directions;
    for (std::size_t i = 0; i < kLooksPerRun; ++i) {
        const Imath::V3f d = product(
            map_from_source,
            Imath::V3f(source_directions.x[i], source_directions.y[i], source_directions.z[i]));
        directions.set(i, d.x, d.y, d.z);
    }
    return directions;
}

void EnvironmentMap::radiances(const LookDirections& source_directions,
                               std::span<const float> footprints_sr,
                               std::span<Imath::V3f> radiances) const {
    LookPoints points;
    find_points(source_directions, footprints_sr, points);
    LookNumbers wanted;
    footprint_levels(footprints_sr, texel_side_radians(layout_, levels_.front().height),
                     wanted);
    const float coarsest = static_cast<float>(levels_.size() - 1);
    float least = coarsest;
    float most = 0;
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        const bool is_coarser = footprints_sr[i] > 0 && wanted[i] > 0;
        wanted[i] = is_coarser ? std::min(wanted[i], coarsest) : 0.0F;
        least = std::min(least, wanted[i]);
        most = std::max(most, wanted[i]);
    }
    std::fill(radiances.begin(), radiances.end(), Imath::V3f(0));
    // A pixel looks between the two levels of the pyramid that are next to its size.
    for (float level = std::floor(least); level <= std::ceil(most); ++level) {
        LookNumbers weights;
        for (std::size_t i = 0; i < radiances.size(); ++i) {
            weights[i] = std::max(0.0F, 1 - std::abs(wanted[i] - level));
        }
        add_level(levels_[static_cast<std::size_t>(level)], points, weights, radiances);
    }
}

void EnvironmentMap::add_level(const Level& level,
                               const LookPoints& points,
                               const LookNumbers& weights,
                               std::span<Imath::V3f> radiances) const {
    const LookLevel texels{
        .rgb = level.rgb.data(), .width = level.width, .height = level.height};
    LookTaps taps;
    const bool all_are_inside = find_taps(texels, points, radiances.size(), taps);
    add_taps(texels, taps, weights, radiances);
    if (all_are_inside) {
        return;
    }
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
