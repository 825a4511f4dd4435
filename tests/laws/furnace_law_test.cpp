// Under a light of radiance 1 from everywhere, white surfaces cannot be told from the light.
#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "tests/laws/bake_estimate.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

namespace relume::test {
namespace {

std::vector<Imath::V3f> constant_light(std::uint32_t n) {
    return std::vector<Imath::V3f>(basis::texel_count(n), Imath::V3f(1));
}

TEST(Furnace, UnoccludedLambertShowsItsAlbedo) {
    for (const std::uint32_t n : {4U, 16U, 32U}) {
        for (const float albedo : {1.0F, 0.37F}) {
            scene::Scene scene = scene::build_builtin_scene("plane");
            scene.materials[0].base_colour = {albedo, albedo / 2, albedo / 4};
            bake::BakeParameters parameters = unbiased_parameters();
            parameters.face_resolution = n;
            const Imath::V3d expected(scene.materials[0].base_colour);
            const LinearImage rows = relit_from_rows(scene, parameters, constant_light(n));
            const test::ScratchDirectory scratch;
            const LinearImage stored = relit_from_stored(scene, parameters, constant_light(n),
                                                         scratch.path() / "plane.relume");
            for (std::size_t p = 0; p < rows.pixels.size(); ++p) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(rows.pixels[p][c], expected[c], 1e-4 * expected[c]) << n;
                    ASSERT_NEAR(stored.pixels[p][c], expected[c], 5e-3 * expected[c]) << n;
                }
            }
        }
    }
}

// What has not left the bowl after all its bounces is missing, and nothing else: half of what
// leaves a facet of a hemisphere leaves the bowl, so 48 bounces leave nothing to speak of. The
// direct part takes visibility and cosine of a texel apart; at the rim that costs 0.0024 of the
// bowl's direct light with n = 8, 0.0007 with 16 and 0.0003 with 32.
TEST(Furnace, WhiteBowlShowsOneEverywhere) {
    constexpr std::uint32_t kSeeds = 10;
    const scene::Scene scene = scene::build_builtin_scene("bowl");
    bake::BakeParameters parameters = unbiased_parameters();
    parameters.width = parameters.height = 16;
    parameters.face_resolution = 32;
    parameters.bounces = 48;
    parameters.samples = 512;
    const Estimate ours = estimate_from_rows(scene, parameters, constant_light(32), kSeeds);
    double sum = 0;
    for (std::size_t p = 0; p < ours.mean.size(); ++p) {
        for (int c = 0; c < 3; ++c) {
            const double error = std::sqrt(ours.variance[p][c]);
            ASSERT_NEAR(ours.mean[p][c], 1, 6 * error + 5e-3) << "pixel " << p;
            ASSERT_LT(error, 0.02);
            sum += ours.mean[p][c];
        }
    }
    const double mean = sum / (3.0 * static_cast<double>(ours.mean.size()));
    std::cout << "  the bowl's mean is " << mean << '\n';
    EXPECT_NEAR(mean, 1, 2e-3);
}

// Too few bounces must be missed: the same picture without them is darker by a known share.
TEST(Furnace, DirectLightAloneIsTheOpenPartOfTheSky) {
    const scene::Scene scene = scene::build_builtin_scene("bowl");
    bake::BakeParameters parameters = unbiased_parameters();
    parameters.width = parameters.height = 16;
    parameters.face_resolution = 32;
    const LinearImage rows = relit_from_rows(scene, parameters, constant_light(32));
    double sum = 0;
    for (const Imath::V3d& pixel : rows.pixels) {
        // On a sphere every patch sees every other with the same density: a hemispherical bowl
        // gives each of its points half of its light, exactly but for the facets.
        EXPECT_NEAR(pixel.x, 0.5, 0.03);
        sum += pixel.x;
    }
    EXPECT_NEAR(sum / static_cast<double>(rows.pixels.size()), 0.5, 0.01);
}

}  // namespace
}  // namespace relume::test
