// A small lamp over a glossy floor: a sum of signed products reflects less than nothing beside
// the highlight.
#include "precompute/factors/brdf_lobes.h"
#include "precompute/factors/factorise.h"
#include "protocol/brdf/local_frame.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/mesh/open_floor.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace relume::stability {
namespace {

constexpr std::uint32_t kTerms = 6;
constexpr std::uint32_t kSide = 48;

scene::Material lacquer() {
    return {.name = "lacquer",
            .model = scene::BsdfModel::phong,
            .base_colour = Imath::V3f(0),
            .specular = Imath::V3f(0.6F),
            .exponent = 30};
}

bake::BakeParameters parameters_of(factors::Method method) {
    bake::BakeParameters parameters = surface_parameters(200);
    parameters.terms = kTerms;
    parameters.factor_method = method;
    return parameters;
}

double lowest(const RelitImage& image) {
    return double{*std::min_element(image.rgb.begin(), image.rgb.end())};
}

// Of ρ, over both hemispheres with their cosines: the unit of Factorisation::largest_negative.
double root_mean_square(const scene::Bsdf& bsdf) {
    constexpr int kPairs = 1 << 18;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto direction = [&] {
        const float radius2 = unit(random);
        const float phi = radians_from_degrees(360 * unit(random));
        return Imath::V3f(std::sqrt(radius2) * std::cos(phi),
                          std::sqrt(radius2) * std::sin(phi), std::sqrt(1 - radius2));
    };
    double sum = 0;
    for (int i = 0; i < kPairs; ++i) {
        const Imath::V3f wi = direction();
        sum += Imath::V3d(bsdf.evaluate(wi, direction())).length2() / 3;
    }
    return std::sqrt(sum / kPairs);
}

Imath::V3f direction_in(const Imath::V2f& disc) {
    return {disc.x, disc.y, std::sqrt(1 - disc.length2())};
}

// Directions to a lamp and to a viewer, in the frame of the floor, for which the terms reflect
// least.
struct WorstPair {
    Imath::V3f to_lamp, to_viewer;
};

WorstPair worst_pair(const brdf::FactoredBrdf& brdf, const std::vector<Imath::V3f>& colours) {
    constexpr int kRadius = 12;
    std::vector<Imath::V3f> directions;
    for (int x = -kRadius; x <= kRadius; ++x) {
        for (int y = -kRadius; y <= kRadius; ++y) {
            const Imath::V2f disc = Imath::V2f(static_cast<float>(x), static_cast<float>(y)) /
                                    static_cast<float>(kRadius);
            if (disc.length() < 0.9F) {
                directions.push_back(direction_in(disc));
            }
        }
    }
    WorstPair worst;
    float least = 0;
    for (const Imath::V3f& to_lamp : directions) {
        for (const Imath::V3f& to_viewer : directions) {
            const float shown = brdf.evaluate(to_lamp, to_viewer, colours).x * to_lamp.z;
            if (shown < least) {
                least = shown;
                worst = {to_lamp, to_viewer};
            }
        }
    }
    return worst;
}

Outcome provoke(Workbench& workbench) {
    const scene::Scene scene = open_floor(lacquer());
    const scene::Bsdf bsdf = bsdf_of(lacquer());
    const BakedSurface by_svd(scene, parameters_of(factors::Method::svd));
    workbench.progress("negative_factors", 0.3);
    const BakedSurface by_nmf(scene, parameters_of(factors::Method::nmf));
    workbench.progress("negative_factors", 0.8);
    const factors::Factorisation factored = factors::factorise(
        "lacquer", bsdf, {.light = factors::LightModel::natural, .terms = kTerms});

    const WorstPair worst = worst_pair(factored.brdf, factors::lobe_colours(bsdf));
    const brdf::Frame frame = brdf::local_frame({0, 1, 0});
    const light::AreaLight lamp{.direction = frame.world_from_local(worst.to_lamp),
                                .angular_radius_radians = radians_from_degrees(4),
                                .radiance = Imath::V3f(100)};
    light::LightCubemap light = constant_sky(by_svd.scene()->face_resolution(), 0);
    light::add_area_light(lamp, light);
    const Lighting lighting = lighting_from_cubemap(light);
    const view::Look look{.eye = Imath::V3d(frame.world_from_local(worst.to_viewer)),
                          .look_at = {0, 0, 0},
                          .up = {0, 1, 0},
                          .fov_degrees = 80,
                          .width = kSide,
                          .height = kSide};
    const RelitImage truth = reflected_image(bsdf, look, light);
    const RelitImage svd = by_svd.image(look, lighting);
    const RelitImage nmf = by_nmf.image(look, lighting);

    const double irradiance =
        double{lamp.radiance.x} * light::solid_angle_sr(lamp) * double{worst.to_lamp.z};
    const double mean_reflected = root_mean_square(bsdf) * irradiance;
    const double below_zero = -lowest(svd) / mean_reflected;
    Outcome outcome;
    outcome.findings = {
        {fmt::format("{} terms by SVD: lowest image value below zero, over what the lamp makes "
                     "in all views (RMS)",
                     kTerms),
         Sense::at_least, 0.1, below_zero, "terms of either sign leave rings"},
        {"the same, over what the factorisation states", Sense::at_most, 1.25,
         below_zero / factored.largest_negative,
         "one light of irradiance E makes E·ρ; the lowest ρ is looked for in 2¹⁵ pairs of "
         "directions, and a quarter is for what lies between them and for storing"},
        {"SVD: norm of all that is negative, over the BRDF's", Sense::reported, 0,
         factored.negative_norm, ""},
        {fmt::format("{} terms by NMF: the same as for SVD", kTerms), Sense::at_most, 0.01,
         -lowest(nmf) / mean_reflected,
         "factors that are not negative reflect nothing negative; a hundredth is for storing"},
    };
    RelitImage below = svd;
    for (float& value : below.rgb) {
        value = std::max(0.0F, -value);
    }
    const auto exposure = static_cast<float>(-std::log2(mean_reflected));
    outcome.tiles = {{truth, "the BRDF itself", exposure},
                     {svd, "6 terms by SVD", exposure},
                     {below, "what of it is below zero", exposure},
                     {nmf, "6 terms by NMF", exposure}};
    return outcome;
}

}  // namespace

Failure negative_factors() {
    return {.name = "negative_factors",
            .what = "terms of either sign reflect less than nothing",
            .scene =
                "a floor with a Phong highlight alone (exponent 30) under a lamp of 4 degrees "
                "that stands "
                "where the terms reflect least, "
                "48x48, n = 16, K = 6",
            .provoke = provoke};
}

}  // namespace relume::stability
