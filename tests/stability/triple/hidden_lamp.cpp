// Bright lamps behind an edge, in the middle of a highlight: large products that cancel.
#include "precompute/materials/field_baker.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/light/area_light.h"
#include "protocol/tripling/sublinear_integral.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/stability/triple/lit_point.h"

#include <algorithm>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::uint32_t n = 64;
constexpr std::size_t kFewTerms = 25;     // a thousandth of them
constexpr std::size_t kLightTerms = 123;  // five thousandths
constexpr float kLampAzimuth = 33;
constexpr float kLampElevation = 50;

std::vector<float> coefficients_of(std::vector<float> texels) {
    basis::haar_forward_cubemap(n, texels);
    return texels;
}

Outcome provoke(Workbench& /*workbench*/) {
    light::LightCubemap light = constant_sky(n, 0.5F);
    light::add_area_light({.direction = direction_from_degrees(kLampAzimuth, kLampElevation),
                           .angular_radius_radians = radians_from_degrees(1),
                           .radiance = Imath::V3f(1e6F)},
                          light);
    // Weaker ones, so that the light has more wavelets than are kept.
    for (int i = 0; i < 40; ++i) {
        light::add_area_light({.direction = direction_from_degrees(
                                   kLampAzimuth + 5 + 3.7F * static_cast<float>(i),
                                   20 + 11.3F * static_cast<float>(i % 6)),
                               .angular_radius_radians = radians_from_degrees(1),
                               .radiance = Imath::V3f(1e5F)},
                              light);
    }
    // A wall stands on the right, and its edge passes two degrees beside the lamp.
    const LitPoint point(n, {0, 1, 0}, [](const Imath::V3f& direction) {
        return std::atan2(direction.x, -direction.z) <
               radians_from_degrees(kLampAzimuth - 2.5F);
    });
    const LitPoint open_point(n, {0, 1, 0}, [](const Imath::V3f&) { return true; });
    const Imath::V3f reflection = direction_from_degrees(kLampAzimuth, kLampElevation);
    const materials::FieldModel model = materials::phong_model(64);
    const materials::TexelSamples samples(n, 2);
    const double truth = point.by_model(model, samples, light, reflection);
    const double lamp = open_point.by_model(model, samples, light, reflection);

    const std::vector<float> planes(light.planes()[0].begin(), light.planes()[0].end());
    const auto l = coefficients_of(planes);
    const auto v = coefficients_of(point.visibility());
    const auto p =
        coefficients_of(materials::lobe_texels(model, samples, point.normal(), reflection)[0]);
    const tripling::SparseWavelets all_light(tripling::nonzero_squares(n, l), l);
    const tripling::SparseWavelets visible(tripling::nonzero_squares(n, v), v);
    const tripling::SparseWavelets all_material(tripling::nonzero_squares(n, p), p);
    const tripling::SparseWavelets few(
        tripling::largest_squares(n, p, kFewTerms, tripling::TermOrder::by_size), p);
    const double by_few = tripling::sublinear_triple_integral(
        all_light, tripling::largest_squares(n, l, kLightTerms, tripling::TermOrder::by_area),
        visible, few);
    const double by_all = tripling::sublinear_triple_integral(all_light, all_light.squares(),
                                                              visible, all_material);
    // A node of the grid of reflections is not where the lamp is: the table is asked at its
    // own node instead.
    const triple::TexelMaterial material = texel_material(model, n, 1, 17, 2);
    const tripling::DirectionGrid grid(17);
    const auto near = grid.nodes_near(reflection);
    const Imath::V3f node = grid.direction(
        std::max_element(near.begin(), near.end(), [](const auto& a, const auto& b) {
            return a.weight < b.weight;
        })->index);
    const double of_node = point.by_model(model, samples, light, node);

    Outcome outcome;
    outcome.findings = {
        {"the lamps that are hidden, over what is left", Sense::at_least, 100, lamp / truth,
         "this is what has to cancel"},
        {"0.1 % of the material's wavelets, 0.5 % of the light's: error, over the truth",
         Sense::at_least, 1, std::abs(by_few - truth) / truth,
         "an edge has wavelets of all sizes, and few of them leave light through"},
        {"all wavelets: error, over the lamp", Sense::at_most, 1e-6,
         std::abs(by_all - truth) / lamp, "coefficients are single, sums are double"},
        {"over open texels: error, over the truth", Sense::at_most, 1e-4,
         std::abs(point.shown(material, light, node) - of_node) / of_node,
         "nothing that is hidden is added; runs of 1e-4 of an entry are left off"},
    };
    return outcome;
}

}  // namespace

Failure hidden_lamp() {
    return {.name = "hidden_lamp",
            .what = "products of large wavelets cancel, and leave their rounding behind",
            .scene =
                "a lamp of radiance 10⁶ and forty weaker ones behind a wall's edge, mirrored "
                "by Phong 64, n = 64",
            .provoke = provoke};
}

}  // namespace relume::stability
