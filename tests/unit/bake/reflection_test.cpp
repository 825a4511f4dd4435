#include "precompute/bake/rows/reflection.h"

#include "protocol/sampling/sobol.h"

#include <gtest/gtest.h>

#include <numeric>

namespace relume::bake {
namespace {

scene::SurfacePoint point_with(const scene::Bsdf& bsdf,
                               const Imath::V3f& normal,
                               const Imath::V3f& wo) {
    scene::SurfacePoint point;
    point.geometric_normal = normal;
    point.shading = scene::Frame::from_normal(normal);
    point.wo = wo.normalized();
    point.bsdf = bsdf;
    return point;
}

double sum(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// ∫ f cos dω by sampling the lobe itself.
Imath::V3d sampled_albedo(const scene::SurfacePoint& point) {
    constexpr std::uint32_t kSamples = 1U << 17U;
    Imath::V3d total{0, 0, 0};
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        total += Imath::V3d(
            point.sample(sampling::sobol_point(i, 8).x, sampling::sobol_point(i, 9)).weight);
    }
    return total / kSamples;
}

TEST(Reflection, ConstantLightOnUnoccludedLambertGivesItsAlbedoExactly) {
    const LightTexels texels(16, 0);
    Reflection reflection;
    for (const Imath::V3f& n : {Imath::V3f(0, 1, 0), Imath::V3f(1, 0, 0),
                                Imath::V3f(0.3F, -0.8F, 0.52F), Imath::V3f(1, 1, 1)}) {
        const auto point =
            point_with(scene::Bsdf::lambert({0.5F, 0.5F, 0.5F}), n.normalized(), {0, 0, 1});
        reflect_light(texels, point, reflection);
        ASSERT_TRUE(reflection.is_diffuse);
        EXPECT_NEAR(sum(reflection.grey), 1, 2e-6);
    }
}

TEST(Reflection, NothingComesFromBelowEitherHorizon) {
    const LightTexels texels(16, 0);
    auto point = point_with(scene::Bsdf::lambert({1, 1, 1}), {0, 1, 0}, {0, 0, 1});
    point.shading = scene::Frame::from_normal(Imath::V3f(0.4F, 1, 0).normalized());
    Reflection reflection;
    reflect_light(texels, point, reflection);
    for (std::size_t place = 0; place < texels.size(); ++place) {
        const bool below =
            texels.direction_y()[place] < -0.1F ||
            0.4F * texels.direction_x()[place] + texels.direction_y()[place] < -0.11F;
        EXPECT_TRUE(!below || reflection.grey[place] == 0) << place;
        EXPECT_GE(reflection.grey[place], 0) << place;
    }
    EXPECT_LT(sum(reflection.grey), 1);
    EXPECT_GT(sum(reflection.grey), 0.95);
}

struct Lobe {
    const char* name;
    scene::Bsdf bsdf;
};

class GlossyReflection : public testing::TestWithParam<Lobe> {};

TEST_P(GlossyReflection, KeepsTheEnergyOfTheLobeHoweverNarrow) {
    const LightTexels texels(16, 0);
    Reflection reflection;
    for (const Imath::V3f& wo :
         {Imath::V3f(0, 0, 1), Imath::V3f(0.5F, 0.2F, 0.8F), Imath::V3f(-0.2F, 0.8F, 0.4F)}) {
        const auto point =
            point_with(GetParam().bsdf, Imath::V3f(0.1F, 0.9F, 0.3F).normalized(), wo);
        reflect_light(texels, point, reflection);
        const Imath::V3d albedo = sampled_albedo(point);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum(reflection.rgb[static_cast<std::size_t>(c)]), albedo[c],
                        0.02 * albedo[c])
                << GetParam().name;
        }
    }
}

TEST_P(GlossyReflection, PartsOfASplitTexelAddUpToIt) {
    const LightTexels texels(16, 0);
    Reflection reflection;
    reflect_light(texels, point_with(GetParam().bsdf, {0, 0, 1}, Imath::V3f(0.4F, 0.1F, 0.7F)),
                  reflection);
    for (const SplitTexel& split : reflection.split) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double parts = std::accumulate(split.rgb[c].begin(), split.rgb[c].end(), 0.0);
            EXPECT_NEAR(parts, reflection.rgb[c][split.place], 1e-5 * parts + 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Lobes,
    GlossyReflection,
    testing::Values(Lobe{"mirror", scene::Bsdf::ggx({1, 0.8F, 0.5F}, 1, 0.05F)},
                    Lobe{"glossy", scene::Bsdf::ggx({0.4F, 0.2F, 0.1F}, 0, 0.2F)},
                    Lobe{"rough", scene::Bsdf::ggx({0.4F, 0.2F, 0.1F}, 0.3F, 0.6F)},
                    Lobe{"phong",
                         scene::Bsdf::phong({0.3F, 0.3F, 0.3F}, {0.4F, 0.4F, 0.4F}, 500)}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace relume::bake
