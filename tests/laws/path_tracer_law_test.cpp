// T·L equals an independent path tracer, pixel by pixel, within the noise of both.
#include "precompute/scene/builtin.h"
#include "protocol/transport/transport.h"
#include "tests/laws/bake_estimate.h"
#include "tests/laws/law_light.h"
#include "tests/laws/picture_comparison.h"
#include "tests/support/reference_tracer/tracer.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>

namespace relume::test {
namespace {

constexpr std::uint32_t kSeeds = 10;
constexpr double kSignificance = 0.01;

struct Case {
    std::string scene;
    std::uint32_t bounces;
    std::string light;  // "sun", or a map's file
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.scene << " with " << c.bounces << " bounces under " << c.light;
}

std::string name_of(const Case& c) {
    return c.scene + "_" + std::to_string(c.bounces) + "_" +
           std::filesystem::path(c.light).stem().string();
}

// `phong` is `thin` with Phong in place of GGX: no built-in scene has it.
scene::Scene scene_of(const std::string& name) {
    if (name != "phong")
        return scene::build_builtin_scene(name);
    scene::Scene scene = scene::build_builtin_scene("thin");
    for (scene::Material& material : scene.materials) {
        if (material.model != scene::BsdfModel::ggx)
            continue;
        material.model = scene::BsdfModel::phong;
        material.specular = {0.5F, 0.45F, 0.4F};
        material.base_colour = {0.2F, 0.25F, 0.4F};
        material.exponent = 24;
    }
    return scene;
}

reference::Sky::Radiance radiance_of(const std::string& light) {
    return light == "sun" ? sun_and_gradient : radiance_from_lat_long(light);
}

class PathTracerLaw : public testing::TestWithParam<Case> {};

TEST_P(PathTracerLaw, BakeEqualsTheReferenceInEveryPixel) {
    const auto& [name, bounces, light] = GetParam();
    const scene::Scene scene = scene_of(name);
    bake::BakeParameters parameters = unbiased_parameters();
    parameters.bounces = bounces;
    if (bounces > 0) {
        // The bake finds the sun by chance alone: a pixel needs some hundred paths that end in
        // it before the spread of its seeds says anything.
        parameters.width = parameters.height = 16;
        parameters.samples = 4096;
    }
    const auto radiance = radiance_of(light);
    const auto texels = cubemap_from_function(parameters.face_resolution, radiance);
    const Estimate ours = estimate_from_rows(scene, parameters, texels, kSeeds);
    reference::TraceOptions options{.width = parameters.width,
                                    .height = parameters.height,
                                    .samples = 2048,
                                    .bounces = bounces,
                                    .seed = 7,
                                    .filter = reference::PixelFilter::centre};
    const auto truth = reference::trace(
        scene, reference::Sky::from_cubemap(parameters.face_resolution, texels), options);
    const PictureComparison comparison =
        compare(ours, truth, options.samples, kSignificance, 0.002);
    std::cout << "  " << GetParam() << ": " << comparison.summary() << '\n';
    options.samples = 512;
    const auto full =
        reference::trace(scene, reference::Sky::from_function(64, radiance), options);
    std::cout << "    distance to the map at full resolution: relative L2 "
              << relative_l2(ours.mean, full.mean) << '\n';
    if (!comparison.is_same())
        ADD_FAILURE() << comparison.summary() << "; evidence in "
                      << write_evidence(name_of(GetParam()), ours, truth, comparison);
}

// The comparison itself must be able to fail: five percent too bright is seen.
TEST(PictureTest, NoticesABakeThatIsFivePercentTooBright) {
    const scene::Scene scene = scene_of("box");
    const bake::BakeParameters parameters = unbiased_parameters();
    const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
    Estimate ours = estimate_from_rows(scene, parameters, texels, kSeeds);
    const reference::TraceOptions options{.width = parameters.width,
                                          .height = parameters.height,
                                          .samples = 2048,
                                          .filter = reference::PixelFilter::centre};
    const auto truth = reference::trace(
        scene, reference::Sky::from_cubemap(parameters.face_resolution, texels), options);
    EXPECT_TRUE(compare(ours, truth, options.samples, kSignificance, 0.002).is_same());
    for (Imath::V3d& pixel : ours.mean)
        pixel *= 1.05;
    EXPECT_FALSE(compare(ours, truth, options.samples, kSignificance, 0.002).is_same());
}

// What the choices of a default bake cost together: antialiasing by one place per surface,
// shared paths, shrinkage, quantisation. Shrinkage spreads the sun's part of interreflection
// over its neighbourhood: in `box` the red wall's share grows and the green one's falls by some
// three percent, on every seed; without it the channels agree.
TEST(DefaultBake, StaysCloseToTheReference) {
    for (const char* name : {"box", "thin"}) {
        const scene::Scene scene = scene_of(name);
        bake::BakeParameters parameters;
        parameters.width = parameters.height = 48;
        parameters.face_resolution = 16;
        parameters.bounces = 3;
        const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
        const test::ScratchDirectory scratch;
        const LinearImage image =
            relit_from_stored(scene, parameters, texels, scratch.path() / "bake.relume");
        const auto truth = reference::trace(
            scene, reference::Sky::from_cubemap(parameters.face_resolution, texels),
            {.width = 48, .height = 48, .samples = 1024, .bounces = 3});
        Imath::V3d ours(0, 0, 0);
        Imath::V3d theirs(0, 0, 0);
        for (std::size_t p = 0; p < image.pixels.size(); ++p) {
            ours += image.pixels[p];
            theirs += truth.mean[p];
        }
        const double distance = relative_l2(image.pixels, truth.mean);
        std::cout << "  " << name << " by default parameters: relative L2 " << distance
                  << ", brightness " << ours / theirs << '\n';
        EXPECT_LT(distance, 0.2) << name;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(ours[c] / theirs[c], 1, 0.05) << name;
    }
}

// Storing adds what the manifest says it adds.
TEST(StoredBake, DiffersFromItsRowsByTheStatedError) {
    for (const char* name : {"box", "thin"}) {
        const scene::Scene scene = scene_of(name);
        bake::BakeParameters parameters = unbiased_parameters();
        parameters.width = parameters.height = 48;
        const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
        const test::ScratchDirectory scratch;
        const auto path = scratch.path() / "bake.relume";
        const LinearImage stored = relit_from_stored(scene, parameters, texels, path);
        const LinearImage rows = relit_from_rows(scene, parameters, texels);
        const auto stated =
            transport::Transport::open(path)->manifest().measured.at("quantisation_error");
        const double distance = relative_l2(stored.pixels, rows.pixels);
        const double sun = stated.at("sun").at("relative_l2").get<double>();
        std::cout << "  " << name << ": stored differs by " << distance
                  << ", stated under a sun " << sun << '\n';
        EXPECT_LE(distance, 1.5 * sun) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(SunAndGradient,
                         PathTracerLaw,
                         testing::Values(Case{"box", 0, "sun"},
                                         Case{"box", 3, "sun"},
                                         Case{"mesh100k", 0, "sun"},
                                         Case{"thin", 0, "sun"},
                                         Case{"thin", 3, "sun"},
                                         Case{"phong", 0, "sun"},
                                         Case{"phong", 3, "sun"}),
                         [](const auto& param_info) { return name_of(param_info.param); });
#ifdef RELUME_CC0_MAP
INSTANTIATE_TEST_SUITE_P(StudioMap,
                         PathTracerLaw,
                         testing::Values(Case{"box", 3, RELUME_CC0_MAP},
                                         Case{"thin", 0, RELUME_CC0_MAP}),
                         [](const auto& param_info) { return name_of(param_info.param); });
#endif

}  // namespace
}  // namespace relume::test
