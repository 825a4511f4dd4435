#include "protocol/light/environment_map.h"

#include "protocol/light/environment_error.h"
#include "protocol/light/map_geometry.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace relume::light {

using Layout = EnvironmentMap::Layout;

namespace {

constexpr std::uint32_t kSmallestLevelSide = 4;

void check(const MapImage& image, Projection projection) {
    if (image.width == 0 || image.height == 0 || image.width > kMaxMapSide ||
        image.height > kMaxMapSide || std::size_t{image.width} * image.height > kMaxMapTexels) {
        const std::string found = fmt::format("{}x{}", image.width, image.height);
        const std::string expected = fmt::format("1 to {} texels a side and at most {} texels",
                                                 kMaxMapSide, kMaxMapTexels);
        throw EnvironmentError(
            fmt::format("environment map is {}, expected {}", found, expected), found,
            expected);
    }
    if (!accepts_shape(projection, image.width, image.height)) {
        const std::string found = fmt::format("{}x{}", image.width, image.height);
        throw EnvironmentError(fmt::format("environment map is {}, expected the shape of {}",
                                           found, describe_shape(projection)),
                               found, describe_shape(projection));
    }
    const std::size_t expected_values = std::size_t{image.width} * image.height * 3;
    if (image.rgb.size() != expected_values) {
        throw EnvironmentError(
            fmt::format("environment map of {}x{} holds {} values, expected {}", image.width,
                        image.height, image.rgb.size(), expected_values),
            std::to_string(image.rgb.size()), std::to_string(expected_values));
    }
    const auto bad = std::find_if_not(image.rgb.begin(), image.rgb.end(), [](float value) {
        return value >= 0 && value <= kMaxTexelRadiance;  // false for NaN
    });
    if (bad != image.rgb.end()) {
        const auto texel = static_cast<std::size_t>(bad - image.rgb.begin()) / 3;
        throw EnvironmentError(
            fmt::format("environment map holds {} at ({}, {}), expected 0 to {}", *bad,
                        texel % image.width, texel / image.width, kMaxTexelRadiance),
            fmt::format("{}", *bad), fmt::format("0 to {}", kMaxTexelRadiance));
    }
}

// Where one face lies in a cross or a strip: its cell, and the cell's axes along the face's.
struct FaceCell {
    std::uint32_t column;
    std::uint32_t row;
    bool flip_x;
    bool flip_y;
};

// Faces of crosses are drawn as seen from inside, those of protocol/README.md §1 as OpenGL's,
// which are mirrored; hence the flips.
constexpr std::array<FaceCell, 6> kVerticalCross{{{2, 1, true, false},
                                                  {0, 1, true, false},
                                                  {1, 0, false, true},
                                                  {1, 2, false, true},
                                                  {1, 3, false, true},
                                                  {1, 1, true, false}}};
constexpr std::array<FaceCell, 6> kHorizontalCross{{{2, 1, true, false},
                                                    {0, 1, true, false},
                                                    {1, 0, false, true},
                                                    {1, 2, false, true},
                                                    {3, 1, true, false},
                                                    {1, 1, true, false}}};

FaceCell face_cell(Projection projection, std::uint32_t face, bool strip_is_wide) {
    switch (projection) {
        case Projection::vertical_cross:
            return kVerticalCross[face];
        case Projection::horizontal_cross:
            return kHorizontalCross[face];
        default:
            return strip_is_wide ? FaceCell{face, 0, false, false}
                                 : FaceCell{0, face, false, false};
    }
}

EnvironmentMap::Level stack_faces(const MapImage& image, Projection projection) {
    const bool wide = image.width > image.height;
    std::uint32_t side = std::min(image.width, image.height);
    if (projection != Projection::cubemap_strip) {
        side /= 3;
    }
    EnvironmentMap::Level level{side, side, {}};
    level.rgb.resize(std::size_t{6} * side * side * 3);
    float* out = level.rgb.data();
    for (std::uint32_t face = 0; face < 6; ++face) {
        const FaceCell cell = face_cell(projection, face, wide);
        for (std::uint32_t row = 0; row < side; ++row) {
            const std::uint32_t y = cell.row * side + (cell.flip_y ? side - 1 - row : row);
            for (std::uint32_t column = 0; column < side; ++column) {
                const std::uint32_t x =
                    cell.column * side + (cell.flip_x ? side - 1 - column : column);
                const float* texel = &image.rgb[(std::size_t{y} * image.width + x) * 3];
                out = std::copy_n(texel, 3, out);
            }
        }
    }
    return level;
}

// Corners of an angular map hold captions or black; let them continue the rim instead, so that
// neither bilinear lookups nor coarser levels mix that in.
void extend_rim(EnvironmentMap::Level& level) {
    const float half = static_cast<float>(level.width) / 2;
    const float innermost = std::max(0.0F, half - std::numbers::sqrt2_v<float> / 2);
    for (std::uint32_t y = 0; y < level.height; ++y) {
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const float dx = static_cast<float>(x) + 0.5F - half;
            const float dy = static_cast<float>(y) + 0.5F - half;
            const float r = std::hypot(dx, dy);
            if (r <= half) {
                continue;
            }
            const auto from_x = static_cast<std::size_t>(half + dx / r * innermost);
            const auto from_y = static_cast<std::size_t>(half + dy / r * innermost);
            std::copy_n(&level.rgb[(from_y * level.width + from_x) * 3], 3,
                        &level.rgb[(std::size_t{y} * level.width + x) * 3]);
        }
    }
}

// The up to three source texels under one of the next level, when `from` texels become
// ⌈from/2⌉: [first, first + 3) with the lengths of their overlap.
struct Overlap {
    std::uint32_t first = 0;
    std::array<float, 3> length{};
};

std::vector<Overlap> overlaps(std::uint32_t from, std::uint32_t to) {
    std::vector<Overlap> result(to);
    const double scale = static_cast<double>(from) / to;
    for (std::uint32_t i = 0; i < to; ++i) {
        const double begin = i * scale;
        const double end = (i + 1) * scale;
        Overlap& overlap = result[i];
        overlap.first = std::min(static_cast<std::uint32_t>(begin), from - 1);
        for (std::uint32_t k = 0; k < 3 && overlap.first + k < from; ++k) {
            const double texel = overlap.first + k;
            overlap.length.at(k) = static_cast<float>(
                std::max(0.0, std::min(end, texel + 1) - std::max(begin, texel)));
        }
    }
    return result;
}

EnvironmentMap::Level next_level(Layout layout, const EnvironmentMap::Level& source) {
    EnvironmentMap::Level level{(source.width + 1) / 2, (source.height + 1) / 2, {}};
    const std::uint32_t rows = face_count(layout) * level.height;
    level.rgb.resize(std::size_t{rows} * level.width * 3);
    const std::vector<Overlap> across = overlaps(source.width, level.width);
    const std::vector<Overlap> down = overlaps(source.height, level.height);
    const float x_scale = 1 / static_cast<float>(source.width);
    const float y_scale = 1 / static_cast<float>(source.height);
    // Where an angular map shows nothing a plain mean will do.
    constexpr float kLeastDensity = 1e-6F;

    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, rows), [&](const auto& range) {
        for (std::uint32_t out_row = range.begin(); out_row != range.end(); ++out_row) {
            const std::uint32_t face = out_row / level.height;
            const Overlap& vertical = down[out_row % level.height];
            float* out = &level.rgb[std::size_t{out_row} * level.width * 3];
            for (std::uint32_t column = 0; column < level.width; ++column) {
                const Overlap& horizontal = across[column];
                Imath::V3f sum(0);
                float weight_sum = 0;
                for (std::uint32_t i = 0; i < 3; ++i) {
                    for (std::uint32_t k = 0; k < 3; ++k) {
                        const float area = vertical.length[i] * horizontal.length[k];
                        if (area == 0) {
                            continue;
                        }
                        const std::uint32_t y = vertical.first + i;
                        const std::uint32_t x = horizontal.first + k;
                        const float density = solid_angle_density_sr(
                            layout, (static_cast<float>(x) + 0.5F) * x_scale,
                            (static_cast<float>(y) + 0.5F) * y_scale);
                        const float weight = area * std::max(density, kLeastDensity);
                        const float* texel =
                            &source
                                 .rgb[((std::size_t{face} * source.height + y) * source.width +
                                       x) *
                                      3];
                        sum += weight * Imath::V3f(texel[0], texel[1], texel[2]);
                        weight_sum += weight;
                    }
                }
                const Imath::V3f mean = sum / weight_sum;
                *out++ = mean.x;
                *out++ = mean.y;
                *out++ = mean.z;
            }
        }
    });
    return level;
}

}  // namespace

EnvironmentMap::EnvironmentMap(MapImage image, Projection projection, MapCentre centre)
    : width_(image.width), height_(image.height), projection_(projection), centre_(centre) {
    check(image, projection);
    switch (projection) {
        case Projection::lat_long:
        case Projection::angular_map:
            layout_ = projection == Projection::lat_long ? Layout::lat_long : Layout::angular;
            levels_.push_back({image.width, image.height, std::move(image.rgb)});
            break;
        default:
            layout_ = Layout::cube_faces;
            levels_.push_back(stack_faces(image, projection));
            image.rgb = {};
            break;
    }
    if (layout_ == Layout::angular) {
        extend_rim(levels_.front());
    }
    while (std::min(levels_.back().width, levels_.back().height) > kSmallestLevelSide) {
        levels_.push_back(next_level(layout_, levels_.back()));
    }
}

Imath::V3d EnvironmentMap::total_energy() const {
    const Level& level = levels_.front();
    const float* texel = level.rgb.data();
    Imath::V3d sum(0);
    double solid_angle = 0;
    for (std::uint32_t row = 0; row < face_count(layout_) * level.height; ++row) {
        const float y =
            (static_cast<float>(row % level.height) + 0.5F) / static_cast<float>(level.height);
        for (std::uint32_t column = 0; column < level.width; ++column, texel += 3) {
            const float x =
                (static_cast<float>(column) + 0.5F) / static_cast<float>(level.width);
            const double weight = solid_angle_density_sr(layout_, x, y);
            sum += weight * Imath::V3d(texel[0], texel[1], texel[2]);
            solid_angle += weight;
        }
    }
    return sum * (4 * std::numbers::pi / solid_angle);
}

}  // namespace relume::light
