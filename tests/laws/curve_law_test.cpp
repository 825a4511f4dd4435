// What a bake of curves says of an image, B₀ + T′c, equals estimators that know nothing of it,
// pixel by pixel, within the noise of both; and what nobody edits has the bits of a bake of
// light.
#include "precompute/bake/curves/curve_rows.h"
#include "precompute/bake/curves/curve_signals.h"
#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap_projection.h"
#include "protocol/curve/curve_shape.h"
#include "tests/laws/bake_estimate.h"
#include "tests/laws/curve_reference.h"
#include "tests/laws/law_light.h"
#include "tests/laws/picture_comparison.h"
#include "tests/support/reference_tracer/random.h"
#include "tests/support/reference_tracer/sky.h"
#include "tests/support/sample_moments.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace relume::test {
namespace {

using bake::EditedMaterial;
using curve::Curve;

constexpr std::uint32_t kSeeds = 10;
constexpr double kSignificance = 0.01;
constexpr std::uint32_t kSide = 24;

bake::BakeParameters law_parameters(std::uint32_t bounces) {
    bake::BakeParameters parameters = unbiased_parameters();
    parameters.width = parameters.height = kSide;
    parameters.face_resolution = 16;
    parameters.bounces = bounces;
    parameters.samples = 16;
    return parameters;
}

// Black past the scene.
bake::FrozenLight frozen_light_of(const std::vector<Imath::V3f>& texels, std::uint32_t n) {
    bake::FrozenLight light;
    light.cubemap.reset(n);
    const auto planes = light.cubemap.planes();
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            planes[c][i] = texels[i][static_cast<int>(c)];
    }
    return light;
}

std::vector<Curve> curves_as_baked(const std::vector<EditedMaterial>& materials) {
    std::vector<Curve> curves;
    for (const EditedMaterial& material : materials)
        curves.push_back(material.brdf.curves()[material.curve].curve);
    return curves;
}

// Pixels of one seed, before anything is quantised.
std::vector<Imath::V3d> image_of_curves(const scene::Scene& scene,
                                        const bake::BakeParameters& parameters,
                                        const bake::FrozenLight& light,
                                        const std::vector<EditedMaterial>& materials,
                                        const std::vector<Curve>& curves) {
    const bake::RayCaster caster(scene);
    const bake::PixelReceivers pixels(caster, parameters);
    const bake::CurveRows rows(caster, pixels, light, materials, parameters);
    const auto signal = bake::signal_from_curves(curves);
    std::vector<Imath::V3d> image(pixels.receiver_count(), Imath::V3d(0, 0, 0));
    tbb::parallel_for(std::size_t{0}, image.size(), [&](std::size_t pixel) {
        std::vector<bake::CoefficientRow> row;
        ASSERT_TRUE(rows.bake_alone(pixel, row));
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t j = 0; j < signal[c].size(); ++j)
                image[pixel][static_cast<int>(c)] +=
                    double{row.front().rgb[c][j]} * double{signal[c][j]};
        }
    });
    return image;
}

Estimate estimate_from_curves(const scene::Scene& scene,
                              bake::BakeParameters parameters,
                              const bake::FrozenLight& light,
                              const std::vector<EditedMaterial>& materials,
                              const std::vector<Curve>& curves) {
    const std::size_t pixels = std::size_t{parameters.width} * parameters.height;
    std::vector<SampleMoments<Imath::V3d>> moments(pixels, SampleMoments(Imath::V3d(0, 0, 0)));
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        parameters.seed = 100 + seed;
        const auto image = image_of_curves(scene, parameters, light, materials, curves);
        for (std::size_t i = 0; i < pixels; ++i)
            moments[i].add(image[i]);
    }
    Estimate estimate{.mean = {}, .variance = {}, .seeds = kSeeds};
    for (const auto& of_pixel : moments) {
        estimate.mean.push_back(of_pixel.mean());
        estimate.variance.push_back(of_pixel.variance_of_mean());
    }
    return estimate;
}

scene::Scene earrings() {
    return scene::build_builtin_scene("earrings");
}

void expect_same(const char* name,
                 const Estimate& ours,
                 const reference::TracedImage& truth,
                 std::uint32_t samples) {
    const PictureComparison comparison = compare(ours, truth, samples, kSignificance, 0.002);
    std::cout << "  " << name << ": " << comparison.summary() << '\n';
    if (!comparison.is_same())
        ADD_FAILURE() << comparison.summary() << "; evidence in "
                      << write_evidence(name, ours, truth, comparison);
}

// Curves as baked, beside the reference tracer.
void expect_shown_as_the_scene(const char* name,
                               const scene::Scene& scene,
                               const bake::BakeParameters& parameters,
                               const std::vector<EditedMaterial>& materials) {
    const std::uint32_t n = parameters.face_resolution;
    const auto texels = cubemap_from_function(n, sun_and_gradient);
    const Estimate ours = estimate_from_curves(scene, parameters, frozen_light_of(texels, n),
                                               materials, curves_as_baked(materials));
    constexpr std::uint32_t kSamples = 2048;
    const auto truth = reference::trace(scene, reference::Sky::from_cubemap(n, texels),
                                        {.width = kSide,
                                         .height = kSide,
                                         .samples = kSamples,
                                         .bounces = parameters.bounces,
                                         .seed = 7,
                                         .filter = reference::PixelFilter::centre});
    expect_same(name, ours, truth, kSamples);
}

TEST(CurveLaw, CurvesAsBakedShowTheSceneWithItsInterreflection) {
    const scene::Scene scene = earrings();
    const bake::BakeParameters parameters = law_parameters(2);
    const auto materials = bake::edited_materials(
        scene, {.edits = {"pearl", "post.fresnel", "cloth"}, .models = {}});
    expect_shown_as_the_scene("curves-as-baked", scene, parameters, materials);
}

// Any curve: jagged, with zeros, coloured.
Curve random_curve(const Curve& of, reference::Random& random) {
    Curve curve;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        Imath::V3f value = of.sample(k);
        for (int c = 0; c < 3; ++c) {
            const double u = random.uniform();
            value[c] *= static_cast<float>(u < 0.2 ? 0.0 : 2 * u);
        }
        curve.set_sample(k, value);
    }
    return curve;
}

// Of a bake whose curves are replaced by jagged ones, beside the reference.
void expect_jagged_curves_are_reflected(const char* name,
                                        const bake::CurveRequest& request,
                                        std::uint32_t bounces,
                                        std::uint64_t seed) {
    const scene::Scene scene = earrings();
    const bake::BakeParameters parameters = law_parameters(bounces);
    const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
    const auto materials = bake::edited_materials(scene, request);
    reference::Random random(seed);
    std::vector<Curve> curves;
    std::map<std::uint32_t, curve::CurveBrdf> edited;
    for (const EditedMaterial& material : materials) {
        curves.push_back(random_curve(material.brdf.curves()[material.curve].curve, random));
        edited.emplace(material.material,
                       material.brdf.with_curve(material.curve, curves.back()));
    }
    const Estimate ours = estimate_from_curves(
        scene, parameters, frozen_light_of(texels, parameters.face_resolution), materials,
        curves);
    constexpr std::uint32_t kSamples = 4096;
    const auto truth = reflect_with_curves(
        scene, reference::Sky::from_cubemap(parameters.face_resolution, texels), edited,
        {.side = kSide, .samples = kSamples, .bounces = bounces});
    expect_same(name, ours, truth, kSamples);
}

TEST(CurveLaw, AnyCurvesShowWhatABrdfOfThoseCurvesReflects) {
    expect_jagged_curves_are_reflected(
        "any-curves",
        {.edits = {"cloth", "post.fresnel", "pearl"},
         .models = {"cloth=ashikhmin-shirley:rs=0.3/0.1/0.2,nu=20,nv=5",
                    "post=cook-torrance:sigma=0.2,n=0.2/0.4/1.3,e=3/2.5/2"}},
        0, 11);
}

TEST(CurveLaw, AnyCurvesShowInterreflectionOfMaterialsAsTheyWere) {
    expect_jagged_curves_are_reflected(
        "any-curves-one-bounce",
        {.edits = {"post", "cloth.fresnel", "pearl"},
         .models = {"post=cook-torrance:sigma=0.2,n=0.2/0.4/1.3,e=3/2.5/2"}},
        1, 12);
    expect_jagged_curves_are_reflected("any-curves-two-bounces",
                                       {.edits = {"pearl.fresnel", "cloth"},
                                        .models = {"cloth=phong:ks=0.4/0.2/0.3,exponent=9"}},
                                       2, 13);
}

// Where the colour of a material varies, the light that its curves scale has the colour of the
// point.
TEST(CurveLaw, AMaterialWhoseColoursVaryShowsThem) {
    scene::Scene scene = earrings();
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = 0.4F;
    for (scene::Mesh& mesh : scene.meshes) {
        mesh.colours.clear();
        for (const Imath::V3f& position : mesh.positions) {
            const float stripe = std::sin(900 * position.x) > 0 ? 1.0F : 0.2F;
            mesh.colours.emplace_back(1, stripe, 0.5F * stripe);
        }
    }
    const bake::BakeParameters parameters = law_parameters(1);
    const auto materials = bake::edited_materials(
        scene, {.edits = {"pearl", "post.fresnel", "cloth"}, .models = {}});
    expect_shown_as_the_scene("curves-of-varied-colour", scene, parameters, materials);
}

// Gold for silver by its curve alone is what a bake with gold shows.
TEST(CurveLaw, ParametersByTheirCurveAreABakeWithThoseParameters) {
    const scene::Scene scene = earrings();
    const bake::BakeParameters parameters = law_parameters(1);
    const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
    const bake::FrozenLight light = frozen_light_of(texels, parameters.face_resolution);
    const auto with_model = [&](const char* model) {
        return bake::edited_materials(scene, {.edits = {"post.fresnel"}, .models = {model}});
    };
    const auto silver = with_model("post=cook-torrance:sigma=0.2,n=0.05/0.06/0.05,e=4/3.3/2.4");
    const auto gold = with_model("post=cook-torrance:sigma=0.2,n=0.18/0.42/1.37,e=3.4/2.3/1.8");
    const auto curve_of_gold = curves_as_baked(gold);
    const auto edited = image_of_curves(scene, parameters, light, silver, curve_of_gold);
    const auto baked = image_of_curves(scene, parameters, light, gold, curve_of_gold);
    const auto before =
        image_of_curves(scene, parameters, light, silver, curves_as_baked(silver));
    EXPECT_LT(relative_l2(edited, baked), 1e-5);
    EXPECT_GT(relative_l2(before, baked), 1e-3);  // or the posts were not in view
}

TEST(CurveLaw, WhatNobodyEditsHasTheBitsOfABakeOfLight) {
    const scene::Scene scene = earrings();
    bake::BakeParameters parameters = law_parameters(1);
    parameters.samples = 8;
    parameters.pixel_samples = 4;
    parameters.pool_radius = 3;
    const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
    const bake::FrozenLight light = frozen_light_of(texels, parameters.face_resolution);
    const auto materials = bake::edited_materials(scene, {.edits = {"pearl"}, .models = {}});
    const bake::RayCaster caster(scene);
    const bake::PixelReceivers pixels(caster, parameters);
    bake::CurveRows curves(caster, pixels, light, materials, parameters);
    bake::LightRows rows(caster, pixels, parameters);
    curves.move_to(0, pixels.cluster_count());
    rows.move_to(0, pixels.cluster_count());
    const auto projection = basis::CubemapProjection::onto(bake::signal_basis(parameters));
    std::size_t compared = 0;
    for (std::size_t pixel = 0; pixel < pixels.receiver_count(); ++pixel) {
        std::vector<bake::CoefficientRow> of_light;
        std::vector<bake::CoefficientRow> of_curves;
        std::uint64_t rays = 0;
        const bake::Receiver seen = pixels.look(pixel);
        float share = 0;
        bool is_edited = false;
        for (const bake::ReceiverSurface& surface : seen.surfaces) {
            share += surface.share;
            is_edited |= surface.material == materials.front().material;
        }
        if (is_edited || share < 0.9999F || !rows.bake(pixel, of_light, rays))
            continue;
        ASSERT_TRUE(curves.bake(pixel, of_curves, rays));
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<float> coefficients(of_light.front().rgb[c].size());
            projection->project_radiance(light.cubemap.planes()[c], coefficients);
            double product = 0;
            for (std::size_t j = 0; j < coefficients.size(); ++j)
                product += double{of_light.front().rgb[c][j]} * double{coefficients[j]};
            ASSERT_EQ(of_curves.front().rgb[c][0], static_cast<float>(product)) << pixel;
        }
        ++compared;
    }
    EXPECT_GT(compared, 100U);
}

}  // namespace
}  // namespace relume::test
