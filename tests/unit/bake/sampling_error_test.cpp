// The error that a bake states of its own sampling.
#include "precompute/bake/sampling_error.h"

#include "precompute/bake/bake.h"
#include "precompute/bake/light_model.h"
#include "precompute/scene/builtin.h"
#include "protocol/basis/haar.h"
#include "protocol/transport/transport.h"
#include "tests/support/dense_product.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

constexpr std::uint32_t kFace = 8;

BakeParameters parameters_with_seed(std::uint64_t seed) {
    return {.width = 64,
            .height = 48,
            .face_resolution = kFace,
            .bounces = 1,
            .samples = 8,
            .pixel_samples = 2,
            .pool_radius = 2,
            .seed = seed};
}

transport::SamplingError stated(const scene::Scene& scene, const BakeParameters& parameters) {
    const scene::Camera camera(scene.camera, parameters.width, parameters.height);
    const RayCaster caster(scene);
    return measure_sampling_error(caster, camera, parameters);
}

TEST(SamplingError, IsThatOfTwoBakesWithSeedsOfTheirOwn) {
    const test::ScratchDirectory scratch;
    for (const char* name : {"box", "thin"}) {
        const scene::Scene scene = scene::build_builtin_scene(name);
        std::vector<std::shared_ptr<const transport::Transport>> bakes;
        for (const std::uint64_t seed : {11U, 12U}) {
            const auto path = scratch.path() / (name + std::to_string(seed) + ".relume");
            bake(scene, parameters_with_seed(seed), path);
            bakes.push_back(transport::Transport::open(path));
        }
        double variance = 0;
        double energy = 0;
        for (std::uint64_t light = 0; light < 4; ++light) {
            std::vector<float> texels = natural_light(bakes[0]->manifest().light_basis, light);
            basis::haar_inverse_cubemap(kFace, texels);
            std::vector<Imath::V3f> radiance;
            for (const float texel : texels) {
                radiance.emplace_back(texel);
            }
            const test::LinearImage a = test::dense_product(*bakes[0], radiance);
            const test::LinearImage b = test::dense_product(*bakes[1], radiance);
            for (std::size_t i = 0; i < a.pixels.size(); ++i) {
                variance += (a.pixels[i] - b.pixels[i]).length2() / 2;
                energy += a.pixels[i].dot(b.pixels[i]);
            }
        }
        const double found = std::sqrt(variance / energy);
        for (const auto& baked : bakes) {
            const auto error = baked->manifest().sampling_error;
            ASSERT_TRUE(error) << name;
            // A few tiles stand for the image.
            EXPECT_GT(error->natural, found / 2) << name;
            EXPECT_LT(error->natural, found * 2) << name;
            EXPECT_GT(error->sun, error->natural) << name;
        }
    }
}

TEST(SamplingError, FallsWithMoreSamples) {
    const scene::Scene scene = scene::build_builtin_scene("box");
    BakeParameters parameters = parameters_with_seed(3);
    const double few = stated(scene, parameters).natural;
    parameters.samples *= 16;
    parameters.pixel_samples *= 4;
    parameters.edge_samples *= 4;
    EXPECT_LT(stated(scene, parameters).natural, 0.6 * few);
}

TEST(SamplingError, IsSmallWhereNothingIsLeftToChance) {
    // An open plane without interreflection: every texel's ray sees the sky.
    BakeParameters parameters = parameters_with_seed(4);
    parameters.bounces = 0;
    parameters.pixel_samples = 1;
    EXPECT_LT(stated(scene::build_builtin_scene("plane"), parameters).natural, 1e-3);
}

}  // namespace
}  // namespace relume::bake
