#include "tests/unit/light/synthetic_maps.h"

#include <array>
#include <cmath>
#include <numbers>

namespace relume::light::testing {
namespace {

constexpr double kPi = std::numbers::pi;

// Cells of a cross are views from inside: what the viewer who faces `forward` sees to the right
// and up. (column, row) counts cells.
struct View {
    int column;
    int row;
    Imath::V3d forward;
    Imath::V3d right;
    Imath::V3d up;
};

const std::array<View, 5> kCommonViews{{
    {1, 0, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},    // looking up from the front view
    {0, 1, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},  // turned left
    {1, 1, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},   // front
    {2, 1, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},    // turned right
    {1, 2, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},  // looking down from the front view
}};
const View kBackTurnedOver{1, 3, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
const View kBackUpright{3, 1, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}};

std::optional<Imath::V3f> in_cross(const View& back, double column, double row) {
    const auto in_view = [&](const View& view) -> std::optional<Imath::V3f> {
        const double s = 2 * (column - view.column) - 1;
        const double t = 2 * (row - view.row) - 1;
        if (std::abs(s) > 1 || std::abs(t) > 1) {
            return std::nullopt;
        }
        return Imath::V3f((view.forward + s * view.right - t * view.up).normalized());
    };
    for (const View& view : kCommonViews) {
        if (const auto direction = in_view(view)) {
            return direction;
        }
    }
    return in_view(back);
}

Imath::V3f in_strip(double along, double across) {
    const int face = std::min(static_cast<int>(along * 6), 5);
    const double u = 2 * (along * 6 - face) - 1;
    const double v = 2 * across - 1;
    const std::array<Imath::V3d, 6> points{
        {{1, -v, -u}, {-1, -v, u}, {u, 1, v}, {u, -1, -v}, {u, -v, 1}, {-u, -v, -1}}};
    return Imath::V3f(points.at(static_cast<std::size_t>(face)).normalized());
}

}  // namespace

std::optional<Imath::V3f> direction_at(
    Projection projection, std::uint32_t width, std::uint32_t height, double x, double y) {
    switch (projection) {
        case Projection::lat_long: {
            const double phi = 2 * kPi * (x - 0.5);
            const double theta = kPi * (0.5 - y);
            return Imath::V3f(Imath::V3d(std::sin(phi) * std::cos(theta), std::sin(theta),
                                         -std::cos(phi) * std::cos(theta)));
        }
        case Projection::angular_map: {
            const double u = 2 * x - 1;
            const double v = 1 - 2 * y;
            const double r = std::hypot(u, v);
            if (r > 1) {
                return std::nullopt;
            }
            const double s = r > 0 ? std::sin(kPi * r) / r : kPi;
            return Imath::V3f(Imath::V3d(s * u, s * v, -std::cos(kPi * r)));
        }
        case Projection::vertical_cross:
            return in_cross(kBackTurnedOver, x * 3, y * 4);
        case Projection::horizontal_cross:
            return in_cross(kBackUpright, x * 4, y * 3);
        case Projection::cubemap_strip:
            break;
    }
    if (width > height) {
        return in_strip(x, y);
    }
    // One face below the other: the face runs with y, its columns still with x.
    const double face = std::min(std::floor(y * 6), 5.0);
    return in_strip((face + x) / 6, y * 6 - face);
}

MapImage draw(Projection projection,
              std::uint32_t width,
              std::uint32_t height,
              const Radiance& radiance,
              std::uint32_t samples,
              float blank) {
    MapImage image{width, height, {}};
    image.rgb.reserve(std::size_t{width} * height * 3);
    for (std::uint32_t row = 0; row < height; ++row) {
        for (std::uint32_t column = 0; column < width; ++column) {
            Imath::V3f sum(0);
            float count = 0;
            for (std::uint32_t i = 0; i < samples * samples; ++i) {
                const double dx = (i % samples + 0.5) / samples;
                const double dy = (static_cast<double>(i / samples) + 0.5) / samples;
                if (const auto direction =
                        direction_at(projection, width, height, (column + dx) / width,
                                     (row + dy) / height)) {
                    sum += radiance(*direction);
                    ++count;
                }
            }
            const Imath::V3f mean = count > 0 ? sum / count : Imath::V3f(blank);
            image.rgb.insert(image.rgb.end(), {mean.x, mean.y, mean.z});
        }
    }
    return image;
}

std::shared_ptr<const EnvironmentMap> lat_long_map(std::uint32_t height,
                                                   const Radiance& radiance,
                                                   std::uint32_t samples) {
    return std::make_shared<EnvironmentMap>(
        draw(Projection::lat_long, 2 * height, height, radiance, samples),
        Projection::lat_long);
}

std::shared_ptr<const EnvironmentMap> one_texel_map(std::uint32_t height,
                                                    std::uint32_t column,
                                                    std::uint32_t row,
                                                    float value) {
    MapImage image{2 * height, height, {}};
    image.rgb.resize(std::size_t{image.width} * height * 3);
    for (std::size_t c = 0; c < 3; ++c) {
        image.rgb[(std::size_t{row} * image.width + column) * 3 + c] = value;
    }
    return std::make_shared<EnvironmentMap>(std::move(image), Projection::lat_long);
}

Imath::V3f smooth_radiance(const Imath::V3f& d) {
    return {1.5F + d.x + 0.3F * d.y * d.z, 1.2F + 0.8F * d.y - 0.3F * d.x * d.z,
            0.9F + 0.6F * d.z * d.z + 0.2F * d.x};
}

Imath::V3f random_direction(std::mt19937& generator) {
    std::normal_distribution<float> normal;
    return Imath::V3f(normal(generator), normal(generator), normal(generator)).normalized();
}

Imath::Quatf random_rotation(std::mt19937& generator) {
    std::normal_distribution<float> normal;
    return Imath::Quatf(normal(generator), normal(generator), normal(generator),
                        normal(generator))
        .normalized();
}

}  // namespace relume::light::testing
