// procedural_sky: daylight after [Preetham99], "A Practical Analytic Model for Daylight".
#include "protocol/light/disc_coverage.h"
#include "protocol/light/environment_error.h"
#include "protocol/light/map_geometry.h"
#include "protocol/light/procedural_environment.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kSunRadiusRadians = 0.00465F;
constexpr float kUnitKcdPerM2 = 10.0F;
// Luminance of the sun's disc above the atmosphere.
constexpr float kSunKcdPerM2 = 1.6e6F;
// The zenith under an evenly overcast sky.
constexpr float kOvercastZenithKcdPerM2 = 6.0F;

using Perez = std::array<float, 5>;

// F(θ, γ) of the all-weather model [Preetham99 eq. 3].
float perez(const Perez& c, float cos_theta, float gamma) {
    const float cos_gamma = std::cos(gamma);
    return (1 + c[0] * std::exp(c[1] / cos_theta)) *
           (1 + c[2] * std::exp(c[3] * gamma) + c[4] * cos_gamma * cos_gamma);
}

// One of Y, x, y over the sky: its distribution and its value at the zenith [Preetham99 A.2].
struct Distribution {
    Perez coefficients;
    float zenith;

    [[nodiscard]] float at(float cos_theta, float gamma, float theta_sun) const {
        return zenith * perez(coefficients, cos_theta, gamma) /
               perez(coefficients, 1, theta_sun);
    }
};

Imath::V3f rgb_from_xyY(float x, float y, float luminance) {
    const float scale = luminance / y;
    const Imath::V3f xyz(x * scale, luminance, (1 - x - y) * scale);
    const Imath::V3f rgb(3.2406F * xyz.x - 1.5372F * xyz.y - 0.4986F * xyz.z,
                         -0.9689F * xyz.x + 1.8758F * xyz.y + 0.0415F * xyz.z,
                         0.0557F * xyz.x - 0.2040F * xyz.y + 1.0570F * xyz.z);
    return {std::max(0.0F, rgb.x), std::max(0.0F, rgb.y), std::max(0.0F, rgb.z)};
}

class Daylight {
  public:
    explicit Daylight(const SkyParameters& p)
        : theta_sun_(kPi / 2 - p.sun_elevation_radians),
          sun_(std::cos(p.sun_elevation_radians) * std::sin(p.sun_azimuth_radians),
               std::sin(p.sun_elevation_radians),
               -std::cos(p.sun_elevation_radians) * std::cos(p.sun_azimuth_radians)) {
        const float t = p.turbidity;
        const float s = theta_sun_;
        const float chi = (4.0F / 9 - t / 120) * (kPi - 2 * s);
        Y_ = {{0.1787F * t - 1.4630F, -0.3554F * t + 0.4275F, -0.0227F * t + 5.3251F,
               0.1206F * t - 2.5771F, -0.0670F * t + 0.3703F},
              std::max(0.05F, (4.0453F * t - 4.9710F) * std::tan(chi) - 0.2155F * t + 2.4192F)};
        x_ = {{-0.0193F * t - 0.2592F, -0.0665F * t + 0.0008F, -0.0004F * t + 0.2125F,
               -0.0641F * t - 0.8989F, -0.0033F * t + 0.0452F},
              t * t * (0.00166F * s * s * s - 0.00375F * s * s + 0.00209F * s) +
                  t * (-0.02903F * s * s * s + 0.06377F * s * s - 0.03202F * s + 0.00394F) +
                  (0.11693F * s * s * s - 0.21196F * s * s + 0.06052F * s + 0.25886F)};
        y_ = {{-0.0167F * t - 0.2608F, -0.0950F * t + 0.0092F, -0.0079F * t + 0.2102F,
               -0.0441F * t - 1.6537F, -0.0109F * t + 0.0529F},
              t * t * (0.00275F * s * s * s - 0.00610F * s * s + 0.00317F * s) +
                  t * (-0.04214F * s * s * s + 0.08970F * s * s - 0.04153F * s + 0.00516F) +
                  (0.15346F * s * s * s - 0.26756F * s * s + 0.06670F * s + 0.26688F)};
        sun_radiance_ = transmitted_sun(p.sun_elevation_radians, t);
    }

    [[nodiscard]] Imath::V3f sky(const Imath::V3f& direction) const {
        // The model ends at the horizon; carry its last value a little on.
        const float cos_theta = std::max(direction.y, 0.01F);
        const float gamma = std::acos(std::clamp(direction.dot(sun_), -1.0F, 1.0F));
        return rgb_from_xyY(
            x_.at(cos_theta, gamma, theta_sun_), y_.at(cos_theta, gamma, theta_sun_),
            std::max(0.0F, Y_.at(cos_theta, gamma, theta_sun_)) / kUnitKcdPerM2);
    }

    [[nodiscard]] const Imath::V3f& sun_direction() const { return sun_; }
    [[nodiscard]] const Imath::V3f& sun_radiance() const { return sun_radiance_; }

  private:
    // Rayleigh scattering and aerosols along the way to the sun [Preetham99 A.1], at one
    // wavelength for each colour.
    static Imath::V3f transmitted_sun(float elevation, float turbidity) {
        const float degrees = (kPi / 2 - elevation) * 180 / kPi;
        const float mass =
            1 / (std::sin(elevation) + 0.15F * std::pow(93.885F - degrees, -1.253F));
        const float beta = 0.04608F * turbidity - 0.04586F;
        const Imath::V3f wavelength_um(0.61F, 0.55F, 0.465F);
        Imath::V3f radiance;
        for (int c = 0; c < 3; ++c) {
            const float rayleigh = 0.008735F * std::pow(wavelength_um[c], -4.08F);
            const float aerosol = beta * std::pow(wavelength_um[c], -1.3F);
            radiance[c] = kSunKcdPerM2 / kUnitKcdPerM2 * std::exp(-(rayleigh + aerosol) * mass);
        }
        return radiance;
    }

    float theta_sun_;
    Imath::V3f sun_;
    Distribution Y_{};
    Distribution x_{};
    Distribution y_{};
    Imath::V3f sun_radiance_;
};

// Moon and Spencer's overcast sky, adopted by the CIE: three times brighter at the zenith.
Imath::V3f overcast_sky(const Imath::V3f& direction) {
    const float value =
        kOvercastZenithKcdPerM2 / kUnitKcdPerM2 * (1 + 2 * std::max(0.0F, direction.y)) / 3;
    return Imath::V3f(value);
}

void check(const SkyParameters& p) {
    const auto require = [](bool holds, const char* name, auto found, const char* expected) {
        if (!holds) {
            throw EnvironmentError(
                fmt::format("{} of the sky is {}, expected {}", name, found, expected),
                fmt::format("{}", found), expected);
        }
    };
    require(p.sun_elevation_radians >= 0 && p.sun_elevation_radians <= kPi / 2 + 1e-6F,
            "sun elevation", p.sun_elevation_radians, "0 to π/2");
    require(std::isfinite(p.sun_azimuth_radians), "sun azimuth", p.sun_azimuth_radians,
            "a finite angle");
    require(p.turbidity >= 1.7F && p.turbidity <= 10, "turbidity", p.turbidity, "1.7 to 10");
    require(p.height >= 16 && p.height <= 4096, "height", p.height, "16 to 4096");
}

// Irradiance of the horizontal ground from the upper half of a lat-long map.
Imath::V3f horizontal_irradiance(const MapImage& image) {
    Imath::V3d sum(0);
    for (std::uint32_t row = 0; row < image.height / 2; ++row) {
        const float y = (static_cast<float>(row) + 0.5F) / static_cast<float>(image.height);
        const double weight =
            double{solid_angle_density_sr(EnvironmentMap::Layout::lat_long, 0, y)} *
            std::cos(std::numbers::pi * double{y}) /
            (static_cast<double>(image.width) * image.height);
        for (std::uint32_t column = 0; column < image.width; ++column) {
            const float* texel = &image.rgb[(std::size_t{row} * image.width + column) * 3];
            sum += weight * Imath::V3d(texel[0], texel[1], texel[2]);
        }
    }
    return Imath::V3f(sum);
}

}  // namespace

EnvironmentMap procedural_sky(const SkyParameters& parameters) {
    check(parameters);
    const Daylight daylight(parameters);
    MapImage image{2 * parameters.height, parameters.height, {}};
    image.rgb.resize(std::size_t{image.width} * image.height * 3);
    const DiscCoverage sun(chord_from_angle(kSunRadiusRadians),
                           2 * kPi / static_cast<float>(image.height));
    const auto fill = [&](std::uint32_t begin, std::uint32_t end, const auto& radiance) {
        tbb::parallel_for(begin, end, [&](std::uint32_t row) {
            float* out = &image.rgb[std::size_t{row} * image.width * 3];
            for (std::uint32_t column = 0; column < image.width; ++column, out += 3) {
                const Imath::V3f direction = direction_from_map_point(
                    EnvironmentMap::Layout::lat_long,
                    {.face = 0,
                     .x = (static_cast<float>(column) + 0.5F) / static_cast<float>(image.width),
                     .y = (static_cast<float>(row) + 0.5F) / static_cast<float>(image.height)});
                const Imath::V3f value = radiance(direction);
                std::copy_n(&value.x, 3, out);
            }
        });
    };
    fill(0, image.height / 2, [&](const Imath::V3f& direction) {
        if (parameters.overcast) {
            return overcast_sky(direction);
        }
        const float disc = sun.at((direction - daylight.sun_direction()).length());
        return daylight.sky(direction) + disc * daylight.sun_radiance();
    });
    const Imath::V3f ground = parameters.ground_albedo * horizontal_irradiance(image) / kPi;
    fill(image.height / 2, image.height, [&](const Imath::V3f&) { return ground; });
    return {std::move(image), Projection::lat_long};
}

}  // namespace relume::light
