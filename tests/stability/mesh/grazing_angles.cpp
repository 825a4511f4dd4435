// A metal floor seen along itself: a microfacet BRDF divides by both cosines.
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/mesh/open_floor.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::uint32_t kSide = 24;
constexpr std::array<double, 8> kElevations{60, 30, 10, 3, 1, 0.3, 0.1, 0.01};

scene::Material metal() {
    return {.name = "metal",
            .model = scene::BsdfModel::ggx,
            .base_colour = Imath::V3f(0.9F),
            .metallic = 1,
            .roughness = 0.5F};
}

// Towards the mirror direction, over straight down and back.
double rise_towards_grazing(const scene::Bsdf& bsdf, double elevation_degrees) {
    const auto elevation = radians_from_degrees(static_cast<float>(elevation_degrees));
    const Imath::V3f wi(std::cos(elevation), 0, std::sin(elevation));
    return double{bsdf.evaluate(wi, {-wi.x, 0, wi.z}).x} /
           double{bsdf.evaluate({0, 0, 1}, {0, 0, 1}).x};
}

double middle(const RelitImage& image) {
    const std::size_t pixel = std::size_t{image.height} / 2 * image.width + image.width / 2;
    return double{image.rgb[3 * pixel]};
}

Outcome provoke(Workbench& workbench) {
    const scene::Bsdf bsdf = bsdf_of(metal());
    bake::BakeParameters parameters = surface_parameters(200);
    parameters.terms = 6;
    const BakedSurface surface(open_floor(metal()), parameters);
    const std::uint32_t n = surface.scene()->face_resolution();
    workbench.progress("grazing_angles", 0.5);

    const light::LightCubemap white = constant_sky(n, 1);
    light::LightCubemap low_sun = constant_sky(n, 0);
    light::add_area_light({.direction = direction_from_degrees(0, 6),
                           .angular_radius_radians = radians_from_degrees(3),
                           .radiance = Imath::V3f(100)},
                          low_sun);
    const std::vector<float> white_sums = surface.exact_sums(lighting_from_cubemap(white));
    const std::vector<float> sun_sums = surface.exact_sums(lighting_from_cubemap(low_sun));

    double brightest = 0;
    double furthest = 0;
    double not_finite = 0;
    double highest_of_sun = 0;
    double true_highest = 0;
    Outcome outcome;
    for (const double elevation : kElevations) {
        const view::Look look = look_at_floor(elevation, 0.004, kSide);
        const RelitImage under_white = surface.image_of_sums(look, white_sums);
        const RelitImage under_sun = surface.image_of_sums(look, sun_sums);
        for (const RelitImage* image : {&under_white, &under_sun}) {
            not_finite += static_cast<double>(
                std::count_if(image->rgb.begin(), image->rgb.end(),
                              [](float value) { return !std::isfinite(value); }));
        }
        const auto e = radians_from_degrees(static_cast<float>(elevation));
        const Imath::V3f to_viewer(0, std::sin(e), std::cos(e));
        const double albedo = reflected(bsdf, to_viewer, white).x;
        brightest = std::max(brightest, middle(under_white));
        furthest = std::max(furthest, std::abs(middle(under_white) - albedo));
        highest_of_sun = std::max(highest_of_sun, middle(under_sun));
        true_highest = std::max(true_highest, reflected(bsdf, to_viewer, low_sun).x);
    }
    outcome.findings = {
        {"the BRDF at 0.1 degrees over the horizon, over that straight on", Sense::at_least,
         1e3, rise_towards_grazing(bsdf, 0.1),
         "1/(4 cos θi cos θo), which masking tames by one"},
        {"60 to 0.01 degrees over the horizon: image values not finite", Sense::at_most, 0,
         not_finite, "tables end in the middle of the last half cell, and are finite"},
        {"under a white sky: brightest", Sense::at_most, 1.02, brightest,
         "no surface gives more than it gets; two hundredths are for terms and storing"},
        {"under a white sky: farthest from what the BRDF reflects", Sense::at_most, 0.05,
         furthest, "a constant light is what terms are best for"},
        {"a sun 6 degrees high: brightest, over the BRDF's brightest", Sense::at_most, 1.25,
         highest_of_sun / true_highest,
         "six terms fade a highlight that narrow; they may ring by a quarter"},
    };
    view::Look wide = look_at_floor(2, 6, 48);
    wide.eye *= 0.5;
    const RelitImage truth = reflected_image(bsdf, wide, low_sun);
    const float exposure = exposure_for(truth);
    outcome.tiles = {{truth, "low sun: the BRDF itself", exposure},
                     {surface.image_of_sums(wide, sun_sums), "6 terms", exposure},
                     {surface.image_of_sums(wide, white_sums), "white sky: 6 terms", -0.5F}};
    return outcome;
}

}  // namespace

Failure grazing_angles() {
    return {.name = "grazing_angles",
            .what = "grazing angles blow up",
            .scene =
                "a rough metal floor (GGX, roughness 0.5) seen from 60 to 0.01 degrees "
                "over its horizon, n = 16, K = 6",
            .provoke = provoke};
}

}  // namespace relume::stability
