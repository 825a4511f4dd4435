// The measure of what a bake's samples leave off, and the reference it is measured by.
#include "tests/lab/measures/bake_noise.h"

#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "tests/lab/measures/reference_file.h"
#include "tests/lab/measures/scene_noise.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

constexpr ReferenceOptions kSmall{.width = 12,
                                  .height = 8,
                                  .face_resolution = 8,
                                  .bounces = 1,
                                  .side = 2,
                                  .edge_side = 4,
                                  .paths = 64};

ReferenceLight constant_light(float radiance) {
    ReferenceLight light{.name = "constant", .texels = {}};
    light.texels.fill(std::vector<float>(basis::texel_count(kSmall.face_resolution), radiance));
    return light;
}

BakeReference traced(const std::string& scene) {
    return trace_reference(scene::build_builtin_scene(scene), {constant_light(1)}, kSmall,
                           [](std::uint32_t) {});
}

TEST(BakeNoise, IsThePicturesErrorAndNotTheReferences) {
    constexpr std::size_t kPixels = 200'000;
    constexpr float kError = 0.02F;
    std::mt19937_64 random(1);
    std::normal_distribution<float> reference_noise(1, 0.1F);
    std::normal_distribution<float> error(0, kError);
    BakeReference reference;
    reference.content.assign(kPixels, PixelContent::matte);
    LitReference& lit = reference.lit.emplace_back();
    lit.key_open.assign(kPixels, 1);
    std::vector<float> picture;
    for (std::size_t i = 0; i < 3 * kPixels; ++i) {
        lit.half[0].push_back(reference_noise(random));
        lit.half[1].push_back(reference_noise(random));
        picture.push_back(1 + error(random));
    }
    const BakeNoise noise = bake_noise(picture, reference, 0);
    EXPECT_NEAR(noise[kMatte].relative_rmse(), double{kError}, 0.05 * double{kError});
    EXPECT_EQ(noise[kMatte].delta_e.size(), kPixels);
}

TEST(BakeNoise, EveryPixelThatSeesTheSceneIsOfOneKind) {
    BakeReference reference;
    reference.content = {PixelContent::nothing, PixelContent::edge,  PixelContent::edge,
                         PixelContent::gloss,   PixelContent::gloss, PixelContent::gloss,
                         PixelContent::matte,   PixelContent::matte};
    LitReference& lit = reference.lit.emplace_back();
    lit.key_open = {0, 0, 0.5F, 0, 0.5F, 1, 0.5F, 0};
    lit.half.fill(std::vector<float>(3 * reference.content.size(), 1.0F));
    const BakeNoise noise = bake_noise(lit.half[0], reference, 0);
    EXPECT_EQ(noise[kEdge].delta_e.size(), 2U);
    EXPECT_EQ(noise[kPenumbra].delta_e.size(), 2U);
    EXPECT_EQ(noise[kGloss].delta_e.size(), 2U);
    EXPECT_EQ(noise[kMatte].delta_e.size(), 1U);
    EXPECT_EQ(noise[kEdge].relative_rmse(), 0);
    EXPECT_EQ(noise[kEdge].mean_delta_e(), 0);
}

TEST(BakeReference, OfAnOpenWhitePlaneIsWhiteUnderConstantLight) {
    const BakeReference reference = traced("plane");
    for (std::size_t pixel = 0; pixel < reference.content.size(); ++pixel) {
        EXPECT_EQ(reference.content[pixel], PixelContent::matte);
        EXPECT_NEAR(reference.lit[0].picture()[3 * pixel], 1, 0.02);
        EXPECT_EQ(reference.lit[0].key_open[pixel], 1);
    }
}

TEST(BakeReference, HalvesAreIndependentAndAgree) {
    const LitReference lit = traced("box").lit[0];
    EXPECT_NE(lit.half[0], lit.half[1]);
    double difference = 0;
    double size = 0;
    for (std::size_t i = 0; i < lit.half[0].size(); ++i) {
        difference += std::pow(double{lit.half[0][i]} - double{lit.half[1][i]}, 2);
        size += double{lit.half[0][i]} * double{lit.half[1][i]};
    }
    EXPECT_LT(difference, 0.01 * size);
}

TEST(SceneNoise, TheErrorThatABakeStatesIsTheOneItHas) {
    const test::ScratchDirectory scratch;
    ReferenceOptions options = kSmall;
    options.width = 48;
    options.height = 36;
    options.paths = 256;
    const std::vector<ReferenceLight> lights = model_lights(options.face_resolution);
    for (const char* name : {"box", "thin"}) {
        const scene::Scene scene = scene::build_builtin_scene(name);
        const BakeReference reference =
            trace_reference(scene, lights, options, [](std::uint32_t) {});
        const bake::BakeParameters parameters{.width = options.width,
                                              .height = options.height,
                                              .face_resolution = options.face_resolution,
                                              .bounces = options.bounces,
                                              .samples = 8,
                                              .pixel_samples = 2,
                                              .pool_radius = 2};
        const SceneNoise noise = measure_noise(scene, lights, reference, parameters, 2,
                                               scratch.path() / "bake.relume");
        const double natural = noise.relative_l2(0, kModelLights);
        const double sun = noise.relative_l2(kModelLights, kModelLights);
        // A sixteenth of the pixels stands for all.
        EXPECT_GT(noise.stated_natural, natural / 1.5) << name;
        EXPECT_LT(noise.stated_natural, natural * 1.5) << name;
        EXPECT_GT(noise.stated_sun, sun / 1.5) << name;
        EXPECT_LT(noise.stated_sun, sun * 1.5) << name;
    }
}

TEST(ReferenceFile, GivesBackWhatWasWrittenAndNothingElse) {
    const test::ScratchDirectory scratch;
    const auto path = scratch.path() / "reference.exr";
    const BakeReference reference = traced("thin");
    EXPECT_FALSE(read_reference(path, 1, kSmall));
    write_reference(path, reference, kSmall);
    const auto read = read_reference(path, 1, kSmall);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->content, reference.content);
    EXPECT_EQ(read->lit[0].half, reference.lit[0].half);
    EXPECT_EQ(read->lit[0].key_open, reference.lit[0].key_open);
    EXPECT_FALSE(read_reference(path, 2, kSmall));
}

TEST(ReferenceFile, IsNamedByWhatAReferenceDependsOn) {
    const auto name = [](const char* scene, float radiance, std::uint32_t side) {
        ReferenceOptions options = kSmall;
        options.side = side;
        return reference_file_name(scene::build_builtin_scene(scene),
                                   {constant_light(radiance)}, options);
    };
    EXPECT_EQ(name("box", 1, 2), name("box", 1, 2));
    EXPECT_NE(name("box", 1, 2), name("plane", 1, 2));
    EXPECT_NE(name("box", 1, 2), name("box", 2, 2));
    EXPECT_NE(name("box", 1, 2), name("box", 1, 3));
}

}  // namespace
}  // namespace relume::lab
