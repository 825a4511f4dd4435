#include "protocol/curve/curve_brdf.h"

#include "precompute/scene/bsdf.h"
#include "protocol/curve/curve_shape.h"
#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace relume::curve {
namespace {

using Imath::V3d;
using Imath::V3f;

constexpr double kPi = std::numbers::pi;

Curve random_curve(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 3);
    return curve_from_function(
        [&](double) { return V3d(uniform(random), uniform(random), uniform(random)); });
}

std::vector<CurveBrdf> all_models() {
    return {CurveBrdf::ggx({0.9F, 0.6F, 0.3F}, 1, 0.09F),
            CurveBrdf::cook_torrance(0.3F, {0.2F, 0.5F, 1.4F}, {3.9F, 2.4F, 1.8F}),
            CurveBrdf::ashikhmin_shirley({0.1F, 0.2F, 0.3F}, 20, 150),
            CurveBrdf::phong({0.5F, 0.4F, 0.3F}, 40),
            CurveBrdf::measured({{CurveAngle::half, random_curve(1)},
                                 {CurveAngle::difference, random_curve(2)},
                                 {CurveAngle::incidence, random_curve(3)},
                                 {CurveAngle::viewing, random_curve(3)}})};
}

// f is Σ_k sample_k · quotient · hat_k, for every curve of every model and for any samples.
TEST(CurveBrdf, IsLinearInTheSamplesOfEveryCurve) {
    HemisphereDirections directions(1);
    for (const CurveBrdf& model : all_models()) {
        for (std::size_t i = 0; i < model.curves().size(); ++i) {
            const Curve curve = random_curve(100 + static_cast<unsigned>(i));
            const CurveBrdf edited = model.with_curve(i, curve);
            for (int pair = 0; pair < 300; ++pair) {
                const V3f wi = directions.next();
                const V3f wo = directions.next();
                const CurvePlace place =
                    curve_place(u_from_directions(model.curves()[i].angle, wi, wo));
                V3f sum(0, 0, 0);
                for (std::size_t k = 0; k < kCurveSamples; ++k) {
                    const float hat = k == place.sample       ? 1 - place.fraction
                                      : k == place.sample + 1 ? place.fraction
                                                              : 0.0F;
                    sum += curve.sample(k) * model.quotient(i, wi, wo) * hat;
                }
                const V3f value = edited.evaluate(wi, wo);
                ASSERT_NEAR((sum - value).length(), 0, 2e-6F * value.length() + 1e-30F);
            }
        }
    }
}

TEST(CurveBrdf, IsReciprocal) {
    HemisphereDirections directions(2);
    for (const CurveBrdf& brdf : all_models()) {
        for (int i = 0; i < 2000; ++i) {
            const V3f wi = directions.next();
            const V3f wo = directions.next();
            const V3f value = brdf.evaluate(wi, wo);
            ASSERT_NEAR((value - brdf.evaluate(wo, wi)).length(), 0, 1e-4F * value.length());
        }
    }
}

TEST(CurveBrdf, IsFiniteAtGrazingAnglesAndZeroBelow) {
    std::vector<CurveBrdf> brdfs = all_models();
    brdfs.push_back(CurveBrdf::ggx(V3f(1), 1, 0.001F));
    brdfs.push_back(CurveBrdf::cook_torrance(0.001F, V3f(0.01F), V3f(20)));
    brdfs.push_back(CurveBrdf::ashikhmin_shirley(V3f(1), 1e5F, 1e5F));
    std::vector<BrdfCurve> highest;
    for (const CurveAngle angle :
         {CurveAngle::half, CurveAngle::difference, CurveAngle::incidence, CurveAngle::viewing,
          CurveAngle::reflection, CurveAngle::along_u}) {
        highest.push_back({angle, constant_curve(V3f(kMostCurveValue))});
    }
    brdfs.push_back(CurveBrdf::measured(highest));
    for (const CurveBrdf& brdf : brdfs) {
        for (const float z : {1e-30F, 1e-12F, 1e-6F, 1e-3F}) {
            for (const float phi : {0.0F, 1.0F, 2.0F, 3.0F, 3.14159265F}) {
                const V3f wi(std::sqrt(1 - z * z), 0, z);
                for (const float other : {1e-30F, 1e-6F, 0.5F, 1.0F}) {
                    const float sine = std::sqrt(1 - other * other);
                    const V3f wo(sine * std::cos(phi), sine * std::sin(phi), other);
                    for (const V3f& value : {brdf.evaluate(wi, wo), brdf.quotient(0, wi, wo)}) {
                        for (int c = 0; c < 3; ++c) {
                            ASSERT_TRUE(std::isfinite(value[c]) && value[c] >= 0)
                                << value[c] << " " << z << " " << other << " " << phi;
                        }
                    }
                    ASSERT_LE(brdf.rest(wi, wo), 5.001e7F);
                    ASSERT_EQ(brdf.evaluate({wi.x, wi.y, -wi.z}, wo), V3f(0));
                    ASSERT_EQ(brdf.evaluate(wi, {wo.x, wo.y, 0}), V3f(0));
                }
            }
        }
    }
}

// What 256 samples lose of the specular part of Bsdf::ggx, relative to the peak of the
// distribution at that ωo. The curve's step is 1/255 in u = √(θ/90°).
TEST(CurveBrdf, GgxIsThatOfTheSceneToTheStatedError) {
    struct Stated {
        float roughness;
        double error;
    };
    // protocol/curves.md §3 has these.
    for (const Stated& stated : {Stated{0.05F, 6e-3}, Stated{0.1F, 2e-3}, Stated{0.2F, 7e-4},
                                 Stated{0.4F, 3e-4}, Stated{0.7F, 1e-4}, Stated{1.0F, 1e-4}}) {
        const V3f base(0.9F, 0.6F, 0.3F);
        const auto bsdf = scene::Bsdf::ggx(base, 1, stated.roughness);  // metal: no diffuse
        const CurveBrdf brdf = CurveBrdf::ggx(base, 1, bsdf.alpha());
        HemisphereDirections directions(4);
        double worst = 0;
        for (int i = 0; i < 20000; ++i) {
            const V3f wo = directions.next();
            if (wo.z < 0.05F) {
                continue;
            }
            // Half vectors of the highlight and around it.
            const V3f h = direction_from_degrees(
                90 * std::pow(i / 20000.0, 3),
                360 * (i * 0.618033988749895 - std::floor(i * 0.618033988749895)));
            const V3f wi = h * (2 * wo.dot(h)) - wo;
            if (wi.z < 0.05F) {
                continue;
            }
            const V3f value = bsdf.evaluate(wi, wo);
            const V3f difference = brdf.evaluate(wi, wo) - value;
            const V3f mirrored(-wo.x, -wo.y, wo.z);
            worst = std::max(worst, static_cast<double>(difference.length() /
                                                        bsdf.evaluate(mirrored, wo).length()));
        }
        RecordProperty("worst", std::to_string(worst));
        EXPECT_LT(worst, stated.error) << stated.roughness;
        EXPECT_GT(worst, stated.error / 2) << stated.roughness;
    }
}

// The models' formulas as their papers have them, in double.
V3d direct_cook_torrance(double sigma, const V3d& n, const V3d& e, V3d wi, V3d wo) {
    const V3d h = (wi + wo).normalized();
    const double d = std::exp(-(1 - h.z * h.z) / (h.z * h.z * sigma * sigma)) /
                     (sigma * sigma * std::pow(h.z, 4));
    const double vh = wo.dot(h);
    const double g = std::min({1.0, 2 * h.z * wo.z / vh, 2 * h.z * wi.z / vh});
    V3d f;
    for (int c = 0; c < 3; ++c) {
        f[c] = fresnel_reflectance(wi.dot(h), n[c], e[c]);
    }
    return f * (g * d / (4 * kPi * wi.z * wo.z));  // [Overbeck06T eq. 3.10]
}

V3d direct_ashikhmin_shirley(const V3d& rs, double nu, double nv, V3d wi, V3d wo) {
    const V3d h = (wi + wo).normalized();
    const double exponent = h.z < 1 ? (nu * h.x * h.x + nv * h.y * h.y) / (1 - h.z * h.z) : 0.0;
    const double vh = wi.dot(h);
    const double scale = std::sqrt((nu + 1) * (nv + 1)) / (8 * kPi) * std::pow(h.z, exponent) /
                         (vh * std::max(wi.z, wo.z));
    return (rs + (V3d(1) - rs) * std::pow(1 - vh, 5)) * scale;
}

template <typename Direct>
void expect_formula(const CurveBrdf& brdf, double peak, const Direct& direct) {
    HemisphereDirections directions(6);
    for (int i = 0; i < 5000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        if (std::min(wi.z, wo.z) < 0.01F) {
            continue;
        }
        const V3d expected = direct(V3d(wi), V3d(wo));
        // Linear between samples: a part of the value, and of the curve's peak.
        const double rest = static_cast<double>(brdf.rest(wi, wo));
        ASSERT_NEAR((V3d(brdf.evaluate(wi, wo)) - expected).length(), 0,
                    1e-3 * expected.length() + 5e-4 * peak * rest);
    }
}

TEST(CurveBrdf, IsTheFormulaOfItsPaper) {
    const V3f n(0.2F, 0.9F, 1.5F);
    const V3f e(3.9F, 2.4F, 0);
    for (const float sigma : {0.1F, 0.3F, 0.8F}) {
        expect_formula(CurveBrdf::cook_torrance(sigma, n, e),
                       1 / (kPi * static_cast<double>(sigma * sigma)),
                       [&](const V3d& wi, const V3d& wo) {
                           return direct_cook_torrance(sigma, V3d(n), V3d(e), wi, wo);
                       });
    }
    const V3f rs(0.05F, 0.4F, 0.9F);
    for (const auto& [nu, nv] : {std::pair{10.0F, 10.0F}, {5.0F, 200.0F}, {300.0F, 3.0F}}) {
        expect_formula(CurveBrdf::ashikhmin_shirley(rs, nu, nv),
                       std::sqrt((nu + 1.0) * (nv + 1.0)),
                       [&, nu = nu, nv = nv](const V3d& wi, const V3d& wo) {
                           return direct_ashikhmin_shirley(V3d(rs), nu, nv, wi, wo);
                       });
    }
    const V3f ks(0.5F, 0.25F, 1);
    expect_formula(CurveBrdf::phong(ks, 30), 32 / (2 * kPi), [&](const V3d& wi, const V3d& wo) {
        const double cosine = std::max(0.0, wi.dot({-wo.x, -wo.y, wo.z}));
        return V3d(ks) * (32 / (2 * kPi) * std::pow(cosine, 30));
    });
}

// Edited parameters are an edited curve, where the model's rest has none of them.
TEST(CurveBrdf, AChangedParameterIsAChangedCurve) {
    const V3f n(0.2F, 0.9F, 1.5F);
    const V3f e(3.9F, 2.4F, 0);
    const CurveBrdf dull = CurveBrdf::cook_torrance(0.4F, n, e);
    const CurveBrdf sharp = CurveBrdf::cook_torrance(0.1F, n, e);
    const CurveBrdf edited = dull.with_curve(0, sharp.curves()[0].curve);
    EXPECT_FALSE(edited.is_of_parameters(0));
    EXPECT_TRUE(edited.is_of_parameters(1));
    const CurveBrdf brushed = CurveBrdf::ashikhmin_shirley(n / 2, 10, 500);
    const CurveBrdf round =
        brushed.with_curve(1, CurveBrdf::ashikhmin_shirley(n / 2, 10, 10).curves()[1].curve);
    HemisphereDirections directions(7);
    for (int i = 0; i < 500; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        EXPECT_EQ(edited.evaluate(wi, wo), sharp.evaluate(wi, wo));
        EXPECT_EQ(round.evaluate(wi, wo),
                  CurveBrdf::ashikhmin_shirley(n / 2, 10, 10).evaluate(wi, wo));
    }
}

TEST(CurveBrdf, ReflectsNoMoreThanItGets) {
    // White furnace, whatever the angle: Cook-Torrance and GGX with F = 1 lose, never gain; so
    // does Phong, whose lobe dips below the horizon.
    for (const CurveBrdf& brdf :
         {CurveBrdf::ggx(V3f(1), 1, 0.25F), CurveBrdf::phong(V3f(1), 12),
          CurveBrdf::cook_torrance(0.4F, V3f(0.01F), V3f(20))}) {
        for (const double theta : {5.0, 45.0, 80.0}) {
            const V3f wo = direction_from_degrees(theta, 30);
            HemisphereDirections directions(8);
            double sum = 0;
            constexpr int kDirections = 100000;
            for (int i = 0; i < kDirections; ++i) {
                const V3f wi = directions.next();
                sum +=
                    static_cast<double>(brdf.evaluate(wi, wo).x * wi.z) * 2 * kPi / kDirections;
            }
            EXPECT_LT(sum, 1.05) << theta;
            EXPECT_GT(sum, 0.2) << theta;
        }
    }
}

TEST(CurveBrdf, NamesItsCurves) {
    const CurveBrdf brdf = CurveBrdf::ashikhmin_shirley(V3f(0.1F), 10, 20);
    EXPECT_EQ(brdf.index_of("spread_v"), 1U);
    EXPECT_EQ(brdf.index_of(CurveAngle::difference), 2U);
    EXPECT_FALSE(brdf.index_of(CurveAngle::half).has_value());
    expect_curve_error([&] { static_cast<void>(brdf.index_of("spred_v")); },
                       "did you mean spread_v");
    expect_curve_error([&] { static_cast<void>(brdf.index_of("distribution")); },
                       "curve of ashikhmin_shirley: found distribution");
}

TEST(CurveBrdf, RefusesBadParametersAndCurves) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_curve_error(
        [&] {
            static_cast<void>(CurveBrdf::ggx({0, nan, 0}, 1, 0.1F));
        },
        "ggx: found nan for f0");
    expect_curve_error([] { static_cast<void>(CurveBrdf::ggx(V3f(0), 1, 1.5F)); },
                       "found 1.5 for alpha, expected 0.001 … 1");
    expect_curve_error([] { static_cast<void>(CurveBrdf::phong(V3f(-0.1F), 10)); }, "for ks");
    expect_curve_error(
        [] { static_cast<void>(CurveBrdf::cook_torrance(0.3F, V3f(1e30F), V3f(1))); }, "for n");
    expect_curve_error([] { static_cast<void>(CurveBrdf::ashikhmin_shirley(V3f(1), -1, 10)); },
                       "for nu");
    expect_curve_error([] { static_cast<void>(CurveBrdf::measured({})); }, "found 0 curves");
    expect_curve_error(
        [] {
            static_cast<void>(CurveBrdf::measured(
                {{CurveAngle::half, random_curve(1)}, {CurveAngle::half, random_curve(2)}}));
        },
        "found curve distribution twice");
    Curve curve = random_curve(1);
    curve.rgb[2][255] = -1;
    expect_curve_error(
        [&] {
            static_cast<void>(CurveBrdf::measured({{CurveAngle::viewing, curve}}));
        },
        "curve viewing: found -1 in blue of sample 255");
    const CurveBrdf phong = CurveBrdf::phong(V3f(1), 10);
    expect_curve_error([&] { static_cast<void>(phong.with_curve(0, curve)); }, "curve lobe");
}

}  // namespace
}  // namespace relume::curve
