// Lights far smaller than a texel, anywhere in it.
#include "protocol/light/rotation_resample.h"
#include "tests/stability/open_plane.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace relume::stability {
namespace {

Imath::V3f random_direction(std::mt19937_64& random, float least_height) {
    std::normal_distribution<float> normal;
    for (;;) {
        const Imath::V3f direction =
            Imath::V3f(normal(random), normal(random), normal(random)).normalized();
        if (direction.y >= least_height) {
            return direction;
        }
    }
}

// One bright texel of a lat-long map, half a degree wide.
light::EnvironmentMap one_texel_map() {
    constexpr std::uint32_t kHeight = 360;
    light::MapImage image{2 * kHeight, kHeight,
                          std::vector<float>(std::size_t{6} * kHeight * kHeight)};
    const std::size_t texel = std::size_t{100} * 2 * kHeight + 200;
    std::fill_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * texel), 3, 1e5F);
    return {std::move(image), light::Projection::lat_long};
}

// Largest relative change of ∫L dω of that sun, over rotations.
double sun_energy_change(std::uint32_t n, std::size_t rotations, std::mt19937_64& random) {
    const auto map = std::make_shared<const light::EnvironmentMap>(one_texel_map());
    const light::PrefilteredEnvironment environment(map, n);
    const double expected = map->total_energy().x;
    std::normal_distribution<float> normal;
    light::LightCubemap cubemap(n);
    double largest = 0;
    for (std::size_t i = 0; i < rotations; ++i) {
        const Imath::Quatf rotation =
            Imath::Quatf(normal(random), normal(random), normal(random), normal(random))
                .normalized();
        light::resample(environment, rotation, Imath::V3f(1), light::Write::overwrite, cubemap);
        largest = std::max(largest, std::abs(total_energy(cubemap).x / expected - 1));
    }
    return largest;
}

Outcome provoke(Workbench& workbench) {
    OpenPlane plane(workbench);
    const std::uint32_t n = plane.face_resolution();
    std::mt19937_64 random(workbench.seed());
    const std::size_t places = workbench.choose<std::size_t>(200, 5000);
    Outcome outcome;
    for (const float degrees : {0.05F, 0.27F, 1.0F}) {
        double energy_error = 0;
        double brightness_error = 0;
        double pointwise_error = 0;
        for (std::size_t i = 0; i < places; ++i) {
            const light::AreaLight light{
                .direction = random_direction(random, 0.5F),
                .angular_radius_radians = radians_from_degrees(degrees),
                .radiance = Imath::V3f(1e5F)};
            light::LightCubemap cubemap(n);
            light::add_area_light(light, cubemap);
            const double energy = double{light.radiance.x} * light::solid_angle_sr(light);
            energy_error =
                std::max(energy_error, std::abs(total_energy(cubemap).x / energy - 1));
            pointwise_error =
                std::max(pointwise_error,
                         std::abs(total_energy(point_sampled(n, light)).x / energy - 1));
            brightness_error = std::max(
                brightness_error,
                std::abs(plane.brightness(cubemap) / OpenPlane::expected_brightness(light) -
                         1) /
                    plane.tolerance(light.direction));
        }
        const std::string size = fmt::format("{} degrees", degrees);
        outcome.findings.push_back(
            {size + ", one texel takes all: energy off, relative", Sense::at_least, 1,
             pointwise_error, "wrong by more than the light: the size is far below a texel"});
        outcome.findings.push_back({size + ", coverage: energy off, relative", Sense::at_most,
                                    1e-5, energy_error,
                                    "some 64 texels summed and scaled in float, ε each"});
        outcome.findings.push_back({size + ": brightness off Eρcosθ/π, of what texels allow",
                                    Sense::at_most, 1, brightness_error,
                                    "tanθ·√2/n, and 1 % for the stored transport"});
        workbench.progress("small_lights", 0.3);
    }
    outcome.findings.push_back(
        {"a sun of one map texel, turned: energy off, relative", Sense::at_most, 0.02,
         sun_energy_change(n, 2 * places, random),
         "the kernel's worst is 1.5 % (protocol/light); 2 % is what its tests hold it to"});
    const light::AreaLight sun{.direction = {0.31F, 1, 0.17F},
                               .angular_radius_radians = radians_from_degrees(0.27F),
                               .radiance = Imath::V3f(1e5F)};
    light::LightCubemap cubemap(n);
    light::add_area_light(sun, cubemap);
    outcome.tiles = {
        {image_of_faces(cubemap.radiance, n), "0.27 degrees by coverage", -6},
        {image_of_faces(point_sampled(n, sun).radiance, n), "one texel takes all", -6}};
    return outcome;
}

}  // namespace

Failure small_lights() {
    return {.name = "small_lights",
            .what = "the energy of a light below the texel's size depends on where it stands",
            .scene = "an open white plane; lights of 0.05 to 1 degree at random places, n = 16",
            .provoke = provoke};
}

}  // namespace relume::stability
