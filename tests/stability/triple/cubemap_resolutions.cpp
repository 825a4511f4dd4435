// Coarse and fine cubemaps: 6×4×4 has less than two words of bits, 6×256×256 has long sums.
#include "precompute/materials/field_baker.h"
#include "protocol/light/area_light.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/stability/triple/lit_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace relume::stability {
namespace {

constexpr std::array<std::uint32_t, 7> kResolutions{4, 8, 16, 32, 64, 128, 256};

light::LightCubemap sky(std::uint32_t n) {
    light::LightCubemap light = constant_sky(n, 0.3F);
    light::add_area_light({.direction = direction_from_degrees(25, 70),
                           .angular_radius_radians = radians_from_degrees(6),
                           .radiance = Imath::V3f(60)},
                          light);
    return light;
}

Outcome provoke(Workbench& /*workbench*/) {
    const Imath::V3f normal(0, 1, 0);
    double worst_rounding = 0;
    std::map<std::uint32_t, double> shown[2];
    for (const std::uint32_t n : kResolutions) {
        const LitPoint point(n, normal,
                             [](const Imath::V3f& direction) { return direction.x > -0.3F; });
        const light::LightCubemap light = sky(n);
        const std::uint32_t samples_per_side = std::max(1U, std::min(8U, 128 / n));
        const materials::TexelSamples samples(n, samples_per_side);
        // At a node, so that all that is left is texels.
        const Imath::V3f reflection(0, 1, 0);
        int i = 0;
        for (const materials::FieldModel& model :
             {materials::lambert_model(), materials::phong_model(16)}) {
            // Three nodes across: one is the middle of a face.
            const triple::TexelMaterial material =
                texel_material(model, n, 3, 3, samples_per_side);
            const double by_server = point.shown(material, light, reflection);
            const double by_sum = point.by_model(model, samples, light, reflection);
            worst_rounding = std::max(worst_rounding, std::abs(by_server - by_sum) / by_sum);
            shown[i++][n] = by_server;
        }
    }
    const auto off = [&](int model, std::uint32_t n) {
        return std::abs(shown[model][n] / shown[model][256] - 1);
    };
    Outcome outcome;
    outcome.findings = {
        {"n = 4 to 256: worst error of the sum over open texels", Sense::at_most, 3e-4,
         worst_rounding, "runs of 1e-4 of an entry are left off, and sums are single"},
        {"n = 4: how far from n = 256, Phong 16", Sense::at_least, 0.02, off(1, 4),
         "texels of twenty degrees hold neither the sun nor the highlight"},
        {"n = 64: the same, Lambert", Sense::at_most, 0.02, off(0, 64),
         "the sky's edge is rounded to a texel"},
        {"n = 64: the same, Phong 16", Sense::at_most, 0.02, off(1, 64), "likewise"},
        {"n = 64, over n = 4: the same, both", Sense::at_most, 0.5,
         (off(0, 64) + off(1, 64)) / (off(0, 4) + off(1, 4)),
         "texels sixteen times finer are closer"},
    };
    return outcome;
}

}  // namespace

Failure cubemap_resolutions() {
    return {
        .name = "cubemap_resolutions",
        .what = "products of coarse and of fine cubemaps lose light",
        .scene = "Lambert and Phong 16 beside a wall under a sun of 12 degrees, n = 4 to 256",
        .provoke = provoke};
}

}  // namespace relume::stability
