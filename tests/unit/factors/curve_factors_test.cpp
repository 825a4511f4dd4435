#include "precompute/factors/curve_factors.h"

#include "precompute/factors/curve_product.h"
#include "precompute/factors/error.h"
#include "protocol/curve/curve_shape.h"
#include "tests/support/merl_file.h"
#include "tests/support/published_fits.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace relume::factors {
namespace {

using curve::CurveAngle;
using curve::CurveBrdf;
using Imath::V3d;
using Imath::V3f;

constexpr double kPi = std::numbers::pi;

BrdfLobes lobes_from_formula(const std::function<V3f(const V3f& wi, const V3f& wo)>& formula) {
    return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            0.1,
            [formula](const V3f& wo, const brdf::Directions& wi, std::span<float> out) {
                const std::size_t count = wi.size();
                for (std::size_t i = 0; i < count; ++i) {
                    const V3f value = formula({wi.x[i], wi.y[i], wi.z[i]}, wo);
                    for (std::size_t c = 0; c < 3; ++c) {
                        out[c * count + i] = value[static_cast<int>(c)];
                    }
                }
            }};
}

curve::Curve shaped(curve::CurveShape shape, double value, CurveAngle angle) {
    const V3d values[]{V3d(value)};
    return curve::curve_from_shape(shape, angle, values);
}

// A product, whose curves are known.
CurveBrdf product() {
    const V3d schlick[]{{0.9, 0.5, 0.2}, V3d(1)};
    const curve::Curve side =
        curve::curve_from_function([](double u) { return V3d(1 + u * u, 1, 1 - 0.5 * u); });
    return CurveBrdf::measured(
        {{CurveAngle::half, shaped(curve::CurveShape::ggx, 0.1, CurveAngle::half)},
         {CurveAngle::difference,
          curve::curve_from_shape(curve::CurveShape::schlick, CurveAngle::difference, schlick)},
         {CurveAngle::incidence, side},
         {CurveAngle::viewing, side}});
}

constexpr CurveMethod kBoth[]{CurveMethod::homomorphic, CurveMethod::nonnegative};

TEST(CurveFactors, RecoverAProduct) {
    const CurveBrdf expected = product();
    const BrdfLobes lobes = lobes_from_formula(
        [&](const V3f& wi, const V3f& wo) { return expected.evaluate(wi, wo); });
    for (const CurveMethod method : kBoth) {
        const CurveFactorisation found = factorise_curves(lobes, method);
        EXPECT_LT(found.errors.relative_l2, 0.01);
        EXPECT_LT(found.errors.logarithmic, 0.01);
        EXPECT_EQ(found.negative_count, 0U);
        ASSERT_EQ(found.brdf.curves().size(), 4U);
        // Every curve is the expected one up to a factor, where directions meet it.
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(found.brdf.curves()[i].angle, expected.curves()[i].angle);
            for (int c = 0; c < 3; ++c) {
                const auto ratio = [&](std::size_t k) {
                    return found.brdf.curves()[i].curve.sample(k)[c] /
                           expected.curves()[i].curve.sample(k)[c];
                };
                for (std::size_t k = 10; k < 230; ++k) {
                    EXPECT_NEAR(ratio(k) / ratio(100), 1, 0.03) << i << " " << k;
                }
            }
        }
    }
}

// Materials that resemble real ones. Nickel: Cook and Torrance's microfacets with the index
// measured for nickel. Plastic: a diffuse layer under a dielectric. Velvet: the distribution of
// [Ashikhmin07] with its smooth shadowing over a dark diffuse ground.
V3f nickel(const V3f& wi, const V3f& wo) {
    static const CurveBrdf brdf =
        CurveBrdf::cook_torrance(0.12F, {1.98F, 1.78F, 1.65F}, {3.74F, 3.32F, 2.65F});
    return brdf.evaluate(wi, wo);
}

V3f plastic(const V3f& wi, const V3f& wo) {
    return scene::Bsdf::ggx({0.55F, 0.08F, 0.06F}, 0, 0.35F).evaluate(wi, wo);
}

V3f velvet(const V3f& wi, const V3f& wo) {
    static const curve::Curve distribution =
        shaped(curve::CurveShape::velvet, 0.5, CurveAngle::half);
    const float d = distribution.at(curve::u_from_directions(CurveAngle::half, wi, wo)).x;
    const float shadowed = 4 * (wi.z + wo.z - wi.z * wo.z);
    return V3f(0.35F, 0.03F, 0.05F) * (d / shadowed) + V3f(0.02F, 0.002F, 0.003F);
}

// Each as a file in MERL's layout.
TEST(CurveFactors, StateTheirErrorsOfMeasuredMaterials) {
    struct Bounds {
        std::string_view name;
        CurveErrors homomorphic;
        CurveErrors nonnegative;
    };
    // precompute/factors/README.md has the errors, rounded.
    constexpr Bounds kBounds[]{
        {"nickel", {0.53, 0.031}, {0.21, 0.065}},
        {"red-plastic", {0.39, 0.031}, {0.27, 0.14}},
        {"red-fabric", {0.27, 0.075}, {0.17, 0.095}},
    };
    for (const test::PublishedFit& fit : test::published_fits()) {
        const Bounds& bounds =
            *std::find_if(std::begin(kBounds), std::end(kBounds),
                          [&](const Bounds& of) { return of.name == fit.name; });
        const MerlBrdf measured("f", test::merl_file([&](const V3f& wi, const V3f& wo) {
                                    return fit.evaluate(wi, wo);
                                }));
        const auto expect_errors = [&](CurveMethod method, const CurveErrors& most) {
            const CurveFactorisation found = factorise_curves(measured, method);
            EXPECT_LT(found.errors.relative_l2, most.relative_l2) << fit.name;
            EXPECT_LT(found.errors.logarithmic, most.logarithmic) << fit.name;
            // The bounds are not idle.
            EXPECT_GT(found.errors.relative_l2, most.relative_l2 / 2) << fit.name;
            EXPECT_EQ(found.unmeasured_count, measured.unmeasured_count());
            EXPECT_GT(found.unmeasured_count, 0U);
            std::cout << fit.name << " by " << kCurveMethodNames.name(method)
                      << ": relative L2 " << found.errors.relative_l2 << ", logarithmic "
                      << found.errors.logarithmic << ", diffuse " << found.diffuse << "\n";
        };
        expect_errors(CurveMethod::homomorphic, bounds.homomorphic);
        expect_errors(CurveMethod::nonnegative, bounds.nonnegative);
    }
}

// A published fit is what its paper says at a pair of directions worked out by hand: both 45
// degrees from the normal and opposite each other, so that θ_h = 0 and θ_d = 45 degrees.
TEST(PublishedFits, AreTheFormulaOfTheirPaper) {
    const test::PublishedFit& plastic = test::published_fits()[1];
    ASSERT_EQ(plastic.name, "red-plastic");
    const float s = std::sqrt(0.5F);
    const V3f found = plastic.evaluate({s, 0, s}, {-s, 0, s});
    // At 45 degrees what is reflected along is the square of what is reflected across.
    const double sin_t = std::sqrt(0.5) / 1.66645;
    const double cos_t = std::sqrt(1 - sin_t * sin_t);
    const double rs =
        std::pow((std::sqrt(0.5) - 1.66645 * cos_t) / (std::sqrt(0.5) + 1.66645 * cos_t), 2);
    const double fresnel = (rs + rs * rs) / 2;
    EXPECT_NEAR(found.x, (0.268 + 1.081538 * fresnel / 0.5) / kPi, 1e-6);
    EXPECT_NEAR(found.z, (0.010675 + 1.037089 * fresnel / 0.5) / kPi, 1e-6);
}

// Means over the samples are means over cos θi dωi cos θo dωo.
TEST(CurveFitSamples, StandForTheSolidAngleTheySay) {
    for (const double shift : {0.5, 0.137}) {
        const CurveFitSamples samples = curve_fit_samples(
            lobes_from_formula([](const V3f& wi, const V3f& wo) {
                return V3f(wi.z, wi.z * wo.z * wo.z,
                           (wi.x - wo.x) * (wi.x - wo.x) + (wi.y - wo.y) * (wi.y - wo.y));
            }),
            1U << 15, shift);
        EXPECT_NEAR(samples.mean.x, 2.0 / 3, 2e-3);
        EXPECT_NEAR(samples.mean.y, 2.0 / 3 * 0.5, 2e-3);
        EXPECT_NEAR(samples.mean.z, 1, 4e-3);  // sin² is a half on average
    }
}

// The errors stated are those of an estimate that draws directions by their cosines.
TEST(CurveFactors, ErrAsTheyState) {
    const BrdfLobes lobes = lobes_from_formula(velvet);
    const CurveFactorisation found = factorise_curves(lobes, CurveMethod::homomorphic);
    CosineDirections directions(5);
    double error = 0;
    double norm = 0;
    for (int i = 0; i < 400000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        if (std::min(wi.z, wo.z) < kLeastJudgedCosine) {
            continue;
        }
        const V3f value = colour_of(lobes, wi, wo);
        const V3f fitted =
            found.diffuse * static_cast<float>(1 / kPi) + found.brdf.evaluate(wi, wo);
        error += static_cast<double>((fitted - value).length2());
        norm += static_cast<double>(value.length2());
    }
    EXPECT_NEAR(std::sqrt(error / norm), found.errors.relative_l2,
                0.15 * found.errors.relative_l2);
}

TEST(CurveFactors, FindADiffuseGroundUnderAHighlight) {
    const CurveBrdf expected = product();
    const V3f ground(0.2F, 0.3F, 0.1F);
    const BrdfLobes lobes = lobes_from_formula([&](const V3f& wi, const V3f& wo) {
        return ground * static_cast<float>(1 / kPi) + expected.evaluate(wi, wo) * 0.3F;
    });
    for (const CurveMethod method : kBoth) {
        const CurveFactorisation found = factorise_curves(lobes, method);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found.diffuse[c] / ground[c], 1, 0.1F);
        }
        EXPECT_LT(found.errors.relative_l2, 0.05);
    }
}

TEST(CurveFactors, NonnegativeUpdatesNeverAddToTheError) {
    const CurveFitSamples samples =
        curve_fit_samples(lobes_from_formula(plastic), 1U << 14, 0.5);
    CurveColumns columns = homomorphic_columns(samples, 0, 0.1);
    const auto error = [&] {
        double sum = 0;
        for (const CurveFitSample& sample : samples.samples) {
            const auto f = factors_at(columns, sample);
            const double beyond = std::max(0.0, sample.value[0] - 0.1);
            sum += sample.solid_angle * std::pow(f[0] * f[1] * f[2] * f[3] - beyond, 2);
        }
        return sum;
    };
    const double before = error();
    improve_nonnegative(samples, 0, 0.1, columns);
    EXPECT_LT(error(), 0.9 * before);
    EXPECT_GE(columns.minCoeff(), 0);
}

TEST(CurveFactors, AreReciprocal) {
    const CurveFactorisation found =
        factorise_curves(lobes_from_formula(nickel), CurveMethod::homomorphic);
    CosineDirections directions(2);
    for (int i = 0; i < 1000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        const V3f value = found.brdf.evaluate(wi, wo);
        EXPECT_NEAR((value - found.brdf.evaluate(wo, wi)).length(), 0, 1e-4F * value.length());
    }
}

TEST(CurveFactors, NegativeAndZeroValuesCountAsZeroAndAreCounted) {
    const BrdfLobes lobes = lobes_from_formula([](const V3f& wi, const V3f& wo) {
        const float lobe = std::pow(std::max(0.0F, (wi + wo).normalized().z), 40.0F);
        return V3f(lobe - 0.1F, wo.z < 0.5F ? 0.0F : lobe, 0);  // blue is black
    });
    for (const CurveMethod method : kBoth) {
        const CurveFactorisation found = factorise_curves(lobes, method);
        EXPECT_GT(found.negative_count, found.value_count / 20);
        EXPECT_GT(found.floored_count, found.negative_count);
        EXPECT_LT(found.floored_count, found.value_count);
        EXPECT_TRUE(std::isfinite(found.errors.relative_l2));
        EXPECT_TRUE(std::isfinite(found.errors.logarithmic));
        CosineDirections directions(3);
        for (int i = 0; i < 1000; ++i) {
            const V3f value = found.brdf.evaluate(directions.next(), directions.next());
            EXPECT_TRUE(std::isfinite(value.x) && std::isfinite(value.y));
            EXPECT_GE(value.x, 0);
            EXPECT_GE(value.y, 0);
            EXPECT_EQ(value.z, 0);
        }
        EXPECT_EQ(found.diffuse.z, 0);
    }
}

TEST(CurveFactors, RefuseWhatReflectsNothingOrNoNumber) {
    const auto expect_refused = [](const V3f& value, const std::string& part) {
        for (const CurveMethod method : kBoth) {
            try {
                static_cast<void>(factorise_curves(
                    lobes_from_formula([value](const V3f&, const V3f&) { return value; }),
                    method));
                ADD_FAILURE() << "accepted, expected: " << part;
            } catch (const FactorError& error) {
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
                    << error.what();
            }
        }
    };
    expect_refused(V3f(0), "is black everywhere, expected");
    expect_refused(V3f(-1), "is black everywhere");
    expect_refused({1, std::numeric_limits<float>::quiet_NaN(), 1}, "expected a finite value");
    expect_refused({1, 1, std::numeric_limits<float>::infinity()}, "expected a finite value");
}

}  // namespace
}  // namespace relume::factors
