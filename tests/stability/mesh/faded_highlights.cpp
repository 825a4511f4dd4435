// A sharp highlight with few terms: it fades, and spreads to where there is none.
#include "precompute/factors/factorise.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/mesh/open_floor.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::uint32_t kMostTerms = 10;
constexpr std::uint32_t kSide = 48;

scene::Material polish() {
    return {.name = "polish",
            .model = scene::BsdfModel::phong,
            .base_colour = Imath::V3f(0.2F),
            .specular = Imath::V3f(0.4F),
            .exponent = 50};
}

// Terms after the first `terms` are black. The floor has one cluster a side of its own, so the
// blocks of each are its terms in turn.
std::vector<float> first_terms(const BakedSurface& surface,
                               std::vector<float> sums,
                               std::uint32_t terms) {
    constexpr std::size_t kBlockFloats = 3 * transport::kBlockSize;
    const transport::VertexClusters& clusters =
        surface.transport().manifest().layout.clusters();
    for (std::uint32_t cluster = 0; cluster < clusters.clusters().size(); ++cluster) {
        for (std::uint32_t term = terms; term < clusters.clusters()[cluster].terms; ++term) {
            const std::size_t first = (clusters.first_block(cluster) + term) * kBlockFloats;
            std::fill_n(&sums[first], kBlockFloats, 0.0F);
        }
    }
    return sums;
}

double highest(const RelitImage& image) {
    return double{*std::max_element(image.rgb.begin(), image.rgb.end())};
}

double relative_error(const RelitImage& image, const RelitImage& truth) {
    return distance(image, truth) / norm(truth);
}

struct MapErrors {
    double worst_over_stated = 0;
    double rise = 0;  // with one more term
    double last = 0;  // with all terms
};

MapErrors errors_under_map(const char* map,
                           const BakedSurface& surface,
                           const std::vector<double>& stated) {
    const std::uint32_t n = surface.scene()->face_resolution();
    light::LightRig rig;
    rig.environment = lab::load_environment(map, n);
    light::LightCubemap light;
    light::evaluate(rig, n, light);
    // The sum over all texels takes its time.
    const view::Look look = look_at_floor(40, 70, 8);
    const RelitImage truth = reflected_image(bsdf_of(polish()), look, light);
    const std::vector<float> sums = surface.exact_sums(lighting_from_cubemap(light));
    MapErrors errors{.last = 1};
    for (std::uint32_t terms = 1; terms <= kMostTerms; ++terms) {
        const double error = relative_error(
            surface.image_of_sums(look, first_terms(surface, sums, terms)), truth);
        errors.worst_over_stated =
            std::max(errors.worst_over_stated, error / stated[terms - 1]);
        errors.rise = std::max(errors.rise, error - errors.last);
        errors.last = error;
    }
    return errors;
}

Outcome provoke(Workbench& workbench) {
    const scene::Bsdf bsdf = bsdf_of(polish());
    bake::BakeParameters parameters = surface_parameters(200);
    parameters.face_resolution = 32;
    parameters.terms = kMostTerms;
    const BakedSurface surface(open_floor(polish()), parameters);
    const std::uint32_t n = surface.scene()->face_resolution();
    const std::vector<double> stated =
        factors::factorise("polish", bsdf,
                           {.light = factors::LightModel::natural, .terms = kMostTerms})
            .errors;
    workbench.progress("faded_highlights", 0.5);

    light::LightCubemap lamp = constant_sky(n, 0);
    light::add_area_light({.direction = direction_from_degrees(0, 50),
                           .angular_radius_radians = radians_from_degrees(4),
                           .radiance = Imath::V3f(100)},
                          lamp);

    const view::Look look = look_at_floor(40, 70, kSide);
    const RelitImage under_lamp = reflected_image(bsdf, look, lamp);
    const std::vector<float> lamp_sums = surface.exact_sums(lighting_from_cubemap(lamp));
    const MapErrors overcast = errors_under_map("sky-overcast", surface, stated);
    const MapErrors studio = errors_under_map("studio", surface, stated);

    Outcome outcome;
    const float exposure = exposure_for(under_lamp);
    std::array<double, kMostTerms> faded{};
    for (std::uint32_t terms = 1; terms <= kMostTerms; ++terms) {
        const RelitImage image =
            surface.image_of_sums(look, first_terms(surface, lamp_sums, terms));
        faded[terms - 1] = 1 - highest(image) / highest(under_lamp);
        if (terms == 1 || terms == 4 || terms == kMostTerms) {
            outcome.tiles.push_back(
                {image,
                 fmt::format("{} terms: {:.2f} of the peak", terms, 1 - faded[terms - 1]),
                 exposure});
        }
    }
    outcome.tiles.insert(outcome.tiles.begin(), {under_lamp, "the BRDF itself", exposure});
    outcome.findings = {
        {"1 term: of the highlight's peak, lost", Sense::at_least, 0.5, faded[0],
         "one product has one highlight for all viewers"},
        {"4 terms: the same", Sense::reported, 0, faded[3], ""},
        {"10 terms: the same", Sense::at_most, faded[0], faded[kMostTerms - 1],
         "each term takes from what the ones before left"},
        {"sky-overcast, 1 to 10 terms: worst image error, over what is stated", Sense::at_most,
         2, overcast.worst_over_stated,
         "stated is the error of natural light from all sides, this one map seen in one way"},
        {"sky-overcast: largest rise of the error with one more term", Sense::at_most, 0.02,
         overcast.rise, "errors of natural light fall with every term; one map may differ"},
        {"studio, small lamps in the dark: worst image error, over what is stated",
         Sense::reported, 0, studio.worst_over_stated, ""},
        {"studio: image error with 10 terms", Sense::reported, 0, studio.last, ""},
    };
    return outcome;
}

}  // namespace

Failure faded_highlights() {
    return {.name = "faded_highlights",
            .what = "too few terms fade a highlight",
            .scene =
                "a floor with a Phong highlight (exponent 50) under a lamp of 4 degrees "
                "and under maps, 48x48, n = 32, K = 1 to 10",
            .provoke = provoke};
}

}  // namespace relume::stability
