// The estimator of curves against closed forms and quadrature.
#include "precompute/bake/curves/curve_estimator.h"

#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "tests/support/sample_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace relume::bake {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFarOff = 5;  // standard errors

light::LightCubemap constant_light() {
    light::LightCubemap light(basis::kMinFaceResolution);
    light.radiance.assign(light.radiance.size(), 1.0F);
    return light;
}

// A plane, seen aslant, of a material whose curves are edited, under a light that is 1
// everywhere.
class CurveEstimatorTest : public testing::Test {
  protected:
    // Moments over seeds of Σ samples · the baked curve.
    [[nodiscard]] test::SampleMoments<double> reflected(const EditedMaterial& material,
                                                        Imath::V3f& wo) const {
        const RayCaster caster(scene_);
        const PixelReceivers pixels(caster, parameters_);
        const Receiver receiver = pixels.look(5 * 8 + 3);
        wo = receiver.surfaces.front().point.wo;
        const sampling::TexelLight light(constant_light());
        const FrozenRadiance radiance(caster, light, 0);
        test::SampleMoments<double> moments(0.0);
        const curve::Curve& curve = material.brdf.curves()[material.curve].curve;
        for (std::uint64_t seed = 0; seed < 24; ++seed) {
            CurveShares shares;
            std::uint64_t rays = 0;
            CurveEstimator(radiance, 24, seed)
                .estimate(receiver.surfaces.front(), receiver.place, material, shares, rays);
            EXPECT_GT(rays, 64U);
            double sum = 0;
            for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
                sum += double{shares.samples[1][k]} * double{curve.rgb[1][k]};
            }
            moments.add(sum);
            diffuse_ = shares.diffuse;
        }
        return moments;
    }

    // ∫ f cos dω by midpoints over the half vector's angles, dense where lobes are.
    [[nodiscard]] static double quadrature(const curve::CurveBrdf& brdf, const Imath::V3f& wo) {
        constexpr int kThetas = 1000;
        constexpr int kPhis = 360;
        double sum = 0;
        for (int i = 0; i < kThetas; ++i) {
            const double u = (i + 0.5) / kThetas;
            const double theta = u * u * kPi / 2;
            const double ring = u * kPi / kThetas * (2 * kPi / kPhis) * std::sin(theta);
            for (int j = 0; j < kPhis; ++j) {
                const double phi = 2 * kPi * (j + 0.5) / kPhis;
                const Imath::V3d h(std::sin(theta) * std::cos(phi),
                                   std::sin(theta) * std::sin(phi), std::cos(theta));
                const double cosine = Imath::V3d(wo).dot(h);
                const Imath::V3d wi = h * (2 * cosine) - Imath::V3d(wo);
                if (cosine > 0 && wi.z > 0) {
                    sum += static_cast<double>(brdf.evaluate(Imath::V3f(wi), wo).y) * wi.z * 4 *
                           cosine * ring;
                }
            }
        }
        return sum;
    }

    scene::Scene scene_ = scene::build_builtin_scene("plane");
    BakeParameters parameters_{.width = 8, .height = 8, .pixel_samples = 1};
    mutable Imath::V3f diffuse_{0, 0, 0};
};

TEST_F(CurveEstimatorTest, SamplesTimesACurveAreTheIntegralOfTheBrdf) {
    using curve::CurveBrdf;
    const std::vector<CurveBrdf> brdfs{
        CurveBrdf::ggx({0.5F, 0.6F, 0.7F}, 1, 0.2F),
        CurveBrdf::cook_torrance(0.3F, {0.2F, 0.4F, 1.3F}, {3, 2.5F, 2}),
        CurveBrdf::ashikhmin_shirley({0.4F, 0.5F, 0.6F}, 40, 8),
        CurveBrdf::phong({0.3F, 0.4F, 0.5F}, 30)};
    for (const CurveBrdf& brdf : brdfs) {
        for (std::size_t curve = 0; curve < brdf.curves().size(); ++curve) {
            const EditedMaterial material{
                .material = 0, .name = "m", .id = "m", .brdf = brdf, .curve = curve};
            Imath::V3f wo;
            const auto found = reflected(material, wo);
            const double expected = quadrature(brdf, wo);
            EXPECT_NEAR(found.mean(), expected,
                        kFarOff * std::sqrt(found.variance_of_mean()) + 2e-3 * expected)
                << curve::kCurveModelNames.name(brdf.model()) << " "
                << brdf.curves()[curve].name();
            EXPECT_LT(std::sqrt(found.variance()), 0.1 * expected);
            // Lambert under white light shows its albedo.
            EXPECT_NEAR(diffuse_.x, scene_.materials[0].base_colour.x, 0.05);
        }
    }
}

TEST_F(CurveEstimatorTest, ACurveOverTheViewersAngleHasTwoSamples) {
    std::vector<curve::BrdfCurve> curves(2);
    curves[0] = {curve::CurveAngle::viewing, curve::constant_curve({1, 1, 1})};
    curves[1] = {curve::CurveAngle::half, curve::constant_curve({0.2F, 0.2F, 0.2F})};
    const EditedMaterial material{.material = 0,
                                  .name = "m",
                                  .id = "m",
                                  .brdf = curve::CurveBrdf::measured(curves),
                                  .curve = 0};
    Imath::V3f wo;
    // A constant of 0.2 per steradian reflects 0.2·π.
    const auto found = reflected(material, wo);
    EXPECT_NEAR(found.mean(), 0.2 * kPi, kFarOff * std::sqrt(found.variance_of_mean()) + 1e-3);
}

}  // namespace
}  // namespace relume::bake
