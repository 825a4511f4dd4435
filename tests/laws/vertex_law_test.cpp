// What the vertices of a surface are given equals an independent path tracer, within the noise
// of both.
#include "precompute/bake/fields/point_visibility.h"
#include "precompute/bake/probes/light_probe.h"
#include "precompute/bake/receivers/vertex/refinement.h"
#include "precompute/bake/receivers/vertex/vertex_places.h"
#include "precompute/bake/receivers/vertex/vertex_receivers.h"
#include "precompute/bake/rows/jitter_shift.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/materials/field_baker.h"
#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/hash.h"
#include "protocol/transport/visibility_field.h"
#include "protocol/tripling/texel_store.h"
#include "server/engine/kernels/open_mixture.h"
#include "tests/laws/bake_estimate.h"
#include "tests/laws/law_light.h"
#include "tests/laws/picture_comparison.h"
#include "tests/support/reference_tracer/tracer.h"
#include "tests/support/sample_moments.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <array>
#include <iostream>
#include <vector>

namespace relume::test {
namespace {

using Imath::V3d;
using Imath::V3f;

constexpr std::size_t kVertices = 300;
constexpr std::size_t kLooked = 48;
constexpr std::uint32_t kSeeds = 10;

// The scene's surface with Lambert BRDFs, and some vertices spread over it.
struct LitSurface {
    scene::Scene scene;
    bake::RayCaster caster{scene};
    std::vector<brdf::FactoredBrdf> brdfs = lambert_of(scene);
    bake::RefinedSurface surface =
        bake::refine_surface(scene,
                             bake::LightProbe(caster, pointers(brdfs), {}),
                             {.most_vertices = kVertices, .target_error = 0});
    bake::VertexReceivers vertices{scene, surface, pointers(brdfs)};

    explicit LitSurface(const char* name) : scene(scene::build_builtin_scene(name)) {}

    [[nodiscard]] const V3f& albedo(std::size_t vertex) const {
        return scene.materials[vertices.look(vertex).surfaces[0].material].base_colour;
    }

    static std::vector<brdf::FactoredBrdf> lambert_of(const scene::Scene& scene) {
        std::vector<brdf::FactoredBrdf> brdfs;
        for (const scene::Material& material : scene.materials) {
            brdfs.push_back(brdf::factored_lambert(material.name, material.base_colour));
        }
        return brdfs;
    }
    static std::vector<const brdf::FactoredBrdf*> pointers(
        const std::vector<brdf::FactoredBrdf>& brdfs) {
        std::vector<const brdf::FactoredBrdf*> all;
        for (const brdf::FactoredBrdf& brdf : brdfs) {
            all.push_back(&brdf);
        }
        return all;
    }
};

// Radiance of some vertices, from the rows of one bake.
std::vector<V3d> radiance_from_rows(const LitSurface& lit,
                                    const std::vector<std::size_t>& looked,
                                    const bake::BakeParameters& parameters,
                                    const std::vector<V3f>& light) {
    const bake::LightTexels texels(parameters.face_resolution, parameters.seed);
    const bake::PathTracer tracer(lit.caster, parameters);
    const bake::RowBaker rows(lit.caster, texels, parameters);
    std::array<std::vector<float>, 3> coefficients;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> plane;
        for (const V3f& texel : light) {
            plane.push_back(texel[static_cast<int>(c)]);
        }
        coefficients[c].resize(rows.projection().basis().coefficient_count());
        rows.projection().project_radiance(plane, coefficients[c]);
    }
    std::vector<V3d> radiance(looked.size(), V3d(0));
    tbb::parallel_for(std::size_t{0}, looked.size(), [&](std::size_t i) {
        bake::RowBaker::Scratch scratch;
        std::vector<bake::CoefficientRow> terms;
        rows.bake(tracer.trace(lit.vertices.look(looked[i])), nullptr, terms, scratch);
        const V3f up{0, 0, 1};
        const brdf::FactoredBrdf& brdf = *lit.vertices.look(looked[i]).surfaces[0].brdf;
        std::array<float, 1> h{};
        brdf.h.evaluate(up, h);
        for (std::size_t c = 0; c < 3; ++c) {
            double product = 0;
            for (std::size_t j = 0; j < coefficients[c].size(); ++j) {
                product += double{terms.at(0).rgb[c][j]} * coefficients[c][j];
            }
            const auto colour = static_cast<int>(c);
            radiance[i][colour] = product * double{h[0]} * lit.albedo(looked[i])[colour];
        }
    });
    return radiance;
}

Estimate estimate(const LitSurface& lit,
                  const std::vector<std::size_t>& looked,
                  bake::BakeParameters parameters,
                  const std::vector<V3f>& light) {
    std::vector<SampleMoments<V3d>> moments(looked.size(), SampleMoments<V3d>(V3d(0)));
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        parameters.seed = seed;
        const std::vector<V3d> radiance = radiance_from_rows(lit, looked, parameters, light);
        for (std::size_t i = 0; i < looked.size(); ++i) {
            moments[i].add(radiance[i]);
        }
    }
    Estimate estimate{.mean = {}, .variance = {}, .seeds = kSeeds};
    for (const SampleMoments<V3d>& of : moments) {
        estimate.mean.push_back(of.mean());
        estimate.variance.push_back(of.variance_of_mean());
    }
    return estimate;
}

// Cameras that look at the places of the vertex from close by: what they see on average.
reference::TracedImage reference_of(const LitSurface& lit,
                                    const std::vector<std::size_t>& looked,
                                    const reference::Sky& sky,
                                    const reference::TraceOptions& options) {
    reference::TracedImage image{.width = static_cast<std::uint32_t>(looked.size()),
                                 .height = 1,
                                 .mean = std::vector<V3d>(looked.size(), V3d(0)),
                                 .variance = std::vector<V3d>(looked.size(), V3d(0))};
    scene::Scene scene = lit.scene;
    const float close = 1e-4F * scene.bounds().size().length();
    for (std::size_t i = 0; i < looked.size(); ++i) {
        const auto places = bake::places_of_vertex(lit.surface, looked[i]);
        reference::TraceOptions of_place = options;
        for (const bake::SurfacePlace& place : places) {
            const scene::SurfacePoint point = bake::surface_point_at(lit.scene, place);
            scene.camera = {.name = "close",
                            .eye = point.position + close * point.geometric_normal,
                            .look_at = point.position,
                            .up = point.shading.tangent,
                            .vertical_fov_degrees = 10};
            ++of_place.seed;
            const reference::TracedImage one = reference::trace(scene, sky, of_place);
            const double share = 1 / static_cast<double>(places.size());
            image.mean[i] += share * one.mean[0];
            image.variance[i] += share * share * one.variance[0];
        }
    }
    return image;
}

// Radiance of vertices as light times visibility times material: the bits of a bake with this
// seed, and the field of a Lambert material.
std::vector<V3d> radiance_from_bits(const LitSurface& lit,
                                    const std::vector<std::size_t>& looked,
                                    std::uint32_t n,
                                    const std::vector<V3f>& light,
                                    std::uint64_t seed) {
    const materials::FieldModel lambert = materials::lambert_model();
    const materials::TexelSamples samples(n, 4);
    const bake::LightTexels texels(n, seed);
    const bake::PointVisibility visibility(lit.caster, texels);
    std::array<std::vector<float>, 3> planes;
    for (std::size_t c = 0; c < 3; ++c) {
        for (const V3f& texel : light) {
            planes[c].push_back(texel[static_cast<int>(c)]);
        }
    }
    std::vector<V3d> radiance(looked.size(), V3d(0));
    tbb::parallel_for(std::size_t{0}, looked.size(), [&](std::size_t i) {
        const bake::Receiver receiver = lit.vertices.look(looked[i]);
        const bake::ReceiverSurface& point = receiver.surfaces.front();
        const V3f normal = lit.surface.mesh.normals[looked[i]];
        const auto material = materials::lobe_texels(lambert, samples, normal, normal).front();
        std::vector<std::uint64_t> open(transport::words_of_visibility(n));
        bake::PointVisibility::Scratch scratch;
        visibility.compute({.origins = point.origins,
                            .geometric_normal = point.point.geometric_normal,
                            .shift = bake::jitter_shift(receiver.place, point.number, seed)},
                           open, scratch);
        tripling::TexelStore store(n);
        store.append(material, 0);
        const std::array one{engine::WeightedTexels{.weight = 1, .function = store.view(0)}};
        const auto sum = engine::sum_open_mixture(
            open, {planes[0].data(), planes[1].data(), planes[2].data()}, one);
        for (std::size_t c = 0; c < 3; ++c) {
            const auto colour = static_cast<int>(c);
            radiance[i][colour] = double{sum[c]} * lit.albedo(looked[i])[colour];
        }
    });
    return radiance;
}

class VertexLaw : public testing::TestWithParam<std::uint32_t> {};

TEST_P(VertexLaw, DiffuseRadianceEqualsTheReference) {
    const LitSurface lit("box");
    std::vector<std::size_t> looked;
    for (std::size_t i = 0; i < kLooked; ++i) {
        looked.push_back(transport::mix_bits(i) % lit.surface.vertex_count());
    }
    bake::BakeParameters parameters = unbiased_parameters();
    parameters.bounces = GetParam();
    parameters.samples = GetParam() == 0 ? 1 : 4096;
    const auto texels = cubemap_from_function(parameters.face_resolution, sun_and_gradient);
    const Estimate ours = estimate(lit, looked, parameters, texels);
    const reference::TraceOptions options{.width = 1,
                                          .height = 1,
                                          .samples = 256,
                                          .bounces = GetParam(),
                                          .seed = 7,
                                          .filter = reference::PixelFilter::centre};
    const reference::TracedImage truth = reference_of(
        lit, looked, reference::Sky::from_cubemap(parameters.face_resolution, texels), options);
    const PictureComparison comparison =
        compare(ours, truth, options.samples * static_cast<std::uint32_t>(bake::kPacketSize),
                0.01, 0.002);
    std::cout << "  " << GetParam() << " bounces: " << comparison.summary() << '\n';
    EXPECT_TRUE(comparison.is_same()) << comparison.summary();

    Estimate brighter = ours;
    for (V3d& mean : brighter.mean) {
        mean *= 1.1;
    }
    EXPECT_FALSE(compare(brighter, truth, options.samples, 0.01, 0.002).is_same());
}

// Direct light from visibility and material fields is that of a path tracer.
TEST(TripleProductLaw, DirectRadianceEqualsTheReference) {
    const LitSurface lit("box");
    std::vector<std::size_t> looked;
    for (std::size_t i = 0; i < kLooked; ++i) {
        looked.push_back(transport::mix_bits(i) % lit.surface.vertex_count());
    }
    constexpr std::uint32_t n = 32;
    const auto texels = cubemap_from_function(n, sun_and_gradient);
    constexpr std::uint32_t kSeedsOfBits = 32;
    std::vector<SampleMoments<V3d>> moments(looked.size(), SampleMoments<V3d>(V3d(0)));
    for (std::uint32_t seed = 1; seed <= kSeedsOfBits; ++seed) {
        const std::vector<V3d> radiance = radiance_from_bits(lit, looked, n, texels, seed);
        for (std::size_t i = 0; i < looked.size(); ++i) {
            moments[i].add(radiance[i]);
        }
    }
    Estimate ours{.mean = {}, .variance = {}, .seeds = kSeedsOfBits};
    for (const SampleMoments<V3d>& of : moments) {
        ours.mean.push_back(of.mean());
        ours.variance.push_back(of.variance_of_mean());
    }
    const reference::TraceOptions options{.width = 1,
                                          .height = 1,
                                          .samples = 256,
                                          .bounces = 0,
                                          .seed = 7,
                                          .filter = reference::PixelFilter::centre};
    const reference::TracedImage truth =
        reference_of(lit, looked, reference::Sky::from_cubemap(n, texels), options);
    const auto rays = options.samples * static_cast<std::uint32_t>(bake::kPacketSize);
    // Within a texel, what is open and how much it counts are multiplied as their means.
    constexpr double kTexelResolution = 0.01;
    const PictureComparison comparison = compare(ours, truth, rays, 0.01, kTexelResolution);
    std::cout << "  triple products: " << comparison.summary() << '\n';
    EXPECT_TRUE(comparison.is_same()) << comparison.summary();

    Estimate brighter = ours;
    for (V3d& mean : brighter.mean) {
        mean *= 1.1;
    }
    EXPECT_FALSE(compare(brighter, truth, rays, 0.01, kTexelResolution).is_same());
}

INSTANTIATE_TEST_SUITE_P(Bounces, VertexLaw, testing::Values(0U, 2U));

}  // namespace
}  // namespace relume::test
