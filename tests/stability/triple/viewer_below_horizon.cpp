// Smoothed normals turn away from a viewer who still sees the surface: the mirrored direction
// belongs to a viewer below the horizon, where a BRDF is not defined.
#include "protocol/light/area_light.h"
#include "protocol/tripling/material_field.h"
#include "tests/stability/mesh/open_floor.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/stability/triple/lit_point.h"

#include <algorithm>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::uint32_t n = 16;
constexpr float kRoughness = 0.5F;

Outcome provoke(Workbench& workbench) {
    const int steps = workbench.choose(60, 600);
    const scene::Bsdf bsdf = scene::Bsdf::ggx(Imath::V3f(1), 1, kRoughness);
    const materials::FieldModel model =
        materials::lobes_model("metal", factors::lobes_of(bsdf));
    const triple::TexelMaterial material = texel_material(model, n, 3, 7, 2);
    const light::LightCubemap white = constant_sky(n, 1);
    light::LightCubemap low_sun = constant_sky(n, 0);
    light::add_area_light({.direction = direction_from_degrees(0, 10),
                           .angular_radius_radians = radians_from_degrees(4),
                           .radiance = Imath::V3f(100)},
                          low_sun);
    const LitPoint point(n, {0, 1, 0}, [](const Imath::V3f&) { return true; });
    double brightest = 0;
    double least = 1e30;
    double of_sun = 0;
    double of_sun_truly = 0;
    double below = 0;
    double jump = 0;
    double before = 0;
    for (int i = 0; i <= steps; ++i) {
        // From 60 degrees over the horizon to as much below it.
        const double elevation = 60.0 - 120.0 * i / steps;
        const auto e = radians_from_degrees(static_cast<float>(elevation));
        const Imath::V3f viewer(0, std::sin(e), std::cos(e));
        const Imath::V3f reflection = tripling::mirrored(viewer, point.normal());
        const double under_white = point.shown(material, white, reflection);
        const double under_sun = point.shown(material, low_sun, reflection);
        brightest = std::max(brightest, under_white);
        least = std::min({least, under_white, under_sun});
        of_sun = std::max(of_sun, under_sun);
        if (elevation >= 1) {
            of_sun_truly = std::max(of_sun_truly, reflected(bsdf, viewer, low_sun).x);
        } else if (elevation < 0) {
            below = std::max(below, std::abs(reflected(bsdf, viewer, white).x));
        }
        jump = std::max(jump, i == 0 ? 0 : std::abs(under_white - before));
        before = under_white;
    }
    Outcome outcome;
    outcome.findings = {
        {"the BRDF itself with a viewer below the horizon: brightest under a white sky",
         Sense::at_most, 0, below, "it is nothing there, so that such a vertex would be black"},
        {"as tabulated, 60 degrees over to 60 below: brightest under a white sky",
         Sense::at_most, 1.1, brightest,
         "no surface gives more than it gets; a tenth is for nodes far apart"},
        {"the same: largest step from image to image", Sense::at_most, 3.0 / steps, jump,
         "a viewer below counts as one at the horizon, so that nothing jumps there"},
        {"the same: least value", Sense::at_least, 0, least, "light is not negative"},
        {"a sun 10 degrees high: brightest, over the BRDF's brightest", Sense::at_most, 1.25,
         of_sun / of_sun_truly, "entries between a grazing node and its neighbour are a mean"},
    };
    return outcome;
}

}  // namespace

Failure viewer_below_horizon() {
    return {
        .name = "viewer_below_horizon",
        .what = "a mirrored direction below the horizon blows a material up, or blackens it",
        .scene =
            "a metal (GGX, roughness 0.5) tabulated over 6×3² normals and 6×7² "
            "reflections, seen from 60 degrees over its horizon to as much below, n = 16",
        .provoke = provoke};
}

}  // namespace relume::stability
