#include "precompute/factors/factorise.h"

#include "precompute/factors/error.h"
#include "precompute/factors/merl_brdf.h"
#include "tests/support/merl_file.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::factors {
namespace {

using Imath::V3f;
using scene::Bsdf;
using test::merl_file;

const Bsdf& glossy() {
    static const Bsdf bsdf = Bsdf::phong({0.3F, 0.2F, 0.1F}, V3f(0.4F), 12);
    return bsdf;
}

// Of the tables, at random pairs of directions.
double measured_error(const BrdfLobes& lobes, const brdf::FactoredBrdf& brdf) {
    CosineDirections directions(7);
    double error = 0;
    double norm = 0;
    for (int i = 0; i < 60000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        const V3f value = colour_of(lobes, wi, wo);
        error += (brdf.evaluate(wi, wo, lobes.mean_colours) - value).length2();
        norm += value.length2();
    }
    return std::sqrt(error / norm);
}

struct NamedLobes {
    std::string name;
    BrdfLobes lobes;
};

std::vector<NamedLobes> materials() {
    return {{"phong 12", lobes_of(glossy())},
            {"phong 60", lobes_of(Bsdf::phong(V3f(0.2F), {0.5F, 0.3F, 0.1F}, 60))},
            {"metal 0.6", lobes_of(Bsdf::ggx({0.9F, 0.6F, 0.3F}, 1, 0.6F))},
            {"dielectric 0.7", lobes_of(Bsdf::ggx({0.3F, 0.6F, 0.5F}, 0, 0.7F))}};
}

struct Factored {
    NamedLobes material;
    Method method;
    Factorisation result;
};

// With six terms each; NMF of two materials only, for it takes seconds.
const std::vector<Factored>& six_terms() {
    static const std::vector<Factored> all = [] {
        std::vector<Factored> made;
        for (const NamedLobes& material : materials()) {
            for (const Method method : {Method::svd, Method::nmf}) {
                if (method == Method::svd || material.lobes.width_rad < 0.5) {
                    made.push_back(
                        {material, method,
                         factorise("m", material.lobes, {.method = method, .terms = 6})});
                }
            }
        }
        return made;
    }();
    return all;
}

TEST(Factorise, ErrsAtRandomDirectionsAsItStates) {
    for (const auto& [material, method, result] : six_terms()) {
        EXPECT_EQ(result.brdf.terms, 6U);
        EXPECT_EQ(result.error, result.errors[5]);
        EXPECT_NEAR(measured_error(material.lobes, result.brdf), result.error,
                    0.02 * result.error + 0.01)
            << material.name;
    }
}

TEST(Factorise, ErrsLessWithEveryTerm) {
    for (const NamedLobes& material : materials()) {
        const auto result = factorise("m", material.lobes);
        ASSERT_EQ(result.errors.size(), 10U);
        EXPECT_TRUE(std::is_sorted(result.errors.rbegin(), result.errors.rend()));
        EXPECT_LT(result.errors.front(), 1);
        const auto more = factorise("m", material.lobes, {.terms = 16});
        ASSERT_EQ(more.errors.size(), 16U);
        for (std::size_t k = 0; k < 10; ++k) {
            EXPECT_NEAR(more.errors[k], result.errors[k], 1e-9);
        }
    }
}

TEST(Factorise, TakesTheFewestTermsThatMeetTheTarget) {
    const BrdfLobes lobes = lobes_of(glossy());
    const auto all = factorise("m", lobes, {.terms = 10});
    for (const double target : {0.6, 0.4, 0.3}) {
        const auto result = factorise("m", lobes, {.target_error = target});
        EXPECT_TRUE(result.meets_target);
        EXPECT_LE(result.error, target);
        EXPECT_FALSE(result.tears_pair);
        // Fewer terms miss it, but for a torn pair.
        const std::uint32_t fewer = result.brdf.terms - 1;
        const auto before = factorise("m", lobes, {.target_error = target, .terms = fewer});
        EXPECT_TRUE(!before.meets_target || before.tears_pair);
        EXPECT_EQ(before.error, all.errors[fewer - 1]);
    }
}

// Of a highlight that ten terms do not hold, as many are taken as are worth it: those after
// them would take less than a tenth of the error, and with fewer they would take more.
TEST(Factorise, WhereTheTargetIsMissedTakesTermsAsLongAsTheyAreWorthIt) {
    bool has_fewer = false;
    for (const Bsdf& bsdf :
         {glossy(), Bsdf::phong(V3f(0.2F), V3f(0.4F), 200), Bsdf::ggx(V3f(0.9F), 1, 0.2F)}) {
        const auto result =
            factorise("m", bsdf, {.light = LightModel::natural, .target_error = 1e-9});
        EXPECT_FALSE(result.meets_target);
        EXPECT_FALSE(result.tears_pair);
        const auto largest_untorn = [&](std::uint32_t below) {
            for (std::uint32_t terms = below; terms > 1; --terms) {
                const FactorOptions options{.light = LightModel::natural, .terms = terms};
                if (!factorise("m", bsdf, options).tears_pair) {
                    return terms;
                }
            }
            return 1U;
        };
        const double least = result.errors[largest_untorn(10) - 1];
        EXPECT_GE(least, 0.9 * result.error - 1e-12);
        if (result.brdf.terms > 1) {
            const double before = result.errors[largest_untorn(result.brdf.terms - 1) - 1];
            EXPECT_LT(least, 0.9 * before);
        }
        has_fewer |= result.brdf.terms < 9;
    }
    EXPECT_TRUE(has_fewer);
}

TEST(Factorise, LambertIsOneTermExactly) {
    const auto result = factorise("matt", Bsdf::lambert({0.7F, 0.4F, 0.1F}));
    EXPECT_EQ(result.brdf.name, "matt");
    EXPECT_EQ(result.brdf.terms, 1U);
    EXPECT_EQ(result.brdf.lobes, 1U);
    EXPECT_EQ(result.errors, std::vector<double>(10, 0.0));
    EXPECT_TRUE(result.meets_target);
    EXPECT_EQ(result.largest_negative, 0);
    // The general way finds the same.
    for (const Method method : {Method::svd, Method::nmf}) {
        const auto general = factorise("matt", lobes_of(Bsdf::lambert({0.7F, 0.4F, 0.1F})),
                                       {.method = method, .target_error = 1e-3});
        EXPECT_EQ(general.brdf.terms, 1U);
        EXPECT_LT(general.error, 1e-4);
        CosineDirections directions(5);
        for (int i = 0; i < 100; ++i) {
            const V3f wi = directions.next();
            const V3f wo = directions.next();
            const std::vector<V3f> colours{{0.7F, 0.4F, 0.1F}};
            EXPECT_NEAR(
                (general.brdf.evaluate(wi, wo, colours) - result.brdf.evaluate(wi, wo, colours))
                    .length(),
                0, 1e-4F);
        }
    }
}

// Scaled so that an error in any term shows alike.
TEST(Factorise, TermsWeighAlikeInTheImage) {
    for (const auto& [material, method, result] : six_terms()) {
        const std::vector<double> weights = material.lobes.weights();
        CosineDirections directions(8);
        std::vector<double> squares(6);
        constexpr int kCount = 40000;
        std::vector<float> h(result.brdf.h.shape().depth);
        for (int i = 0; i < kCount; ++i) {
            result.brdf.h.evaluate(directions.next(), h);
            for (std::size_t k = 0; k < squares.size(); ++k) {
                for (std::size_t l = 0; l < material.lobes.count(); ++l) {
                    const double value = weights[l] * h[k * material.lobes.count() + l];
                    squares[k] += value * value / kCount;
                }
            }
        }
        for (const double square : squares) {
            EXPECT_NEAR(square, 1, 0.05) << material.name;
        }
    }
}

TEST(Factorise, TurningBothDirectionsChangesNothingUnlessAPairIsTorn) {
    const BrdfLobes lobes = lobes_of(glossy());
    const auto largest_change = [&](const Factorisation& result) {
        CosineDirections directions(9);
        double change = 0;
        double norm = 0;
        for (int i = 0; i < 4000; ++i) {
            const V3f wi = directions.next();
            const V3f wo = directions.next();
            const V3f value = result.brdf.evaluate(wi, wo, lobes.mean_colours);
            const V3f around = result.brdf.evaluate(turned(wi, 0.4 + i), turned(wo, 0.4 + i),
                                                    lobes.mean_colours);
            change += (value - around).length2();
            norm += value.length2();
        }
        return std::sqrt(change / norm);
    };
    bool has_torn = false;
    bool has_whole = false;
    for (std::uint32_t terms = 2; terms <= 8; ++terms) {
        const auto result = factorise("m", lobes, {.terms = terms});
        if (result.tears_pair) {
            EXPECT_GT(largest_change(result), 0.05) << terms;
            has_torn = true;
        } else {
            EXPECT_LT(largest_change(result), 0.005) << terms;
            has_whole = true;
        }
    }
    EXPECT_TRUE(has_torn && has_whole);
}

TEST(Factorise, StatesWhatIsNegative) {
    const BrdfLobes lobes = lobes_of(Bsdf::phong(V3f(0), V3f(1), 30));
    const auto svd = factorise("m", lobes, {.terms = 6});
    const auto nmf = factorise("m", lobes, {.method = Method::nmf, .terms = 6});
    EXPECT_EQ(nmf.largest_negative, 0);
    EXPECT_EQ(nmf.negative_norm, 0);
    CosineDirections directions(10);
    double lowest = 0;
    double negative = 0;
    double norm = 0;
    constexpr int kCount = 40000;
    for (int i = 0; i < kCount; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        const double value = svd.brdf.evaluate(wi, wo, lobes.mean_colours).x;
        lowest = std::min(lowest, value);
        negative += std::pow(std::min(0.0, value), 2);
        norm += std::pow(colour_of(lobes, wi, wo).x, 2);
        EXPECT_GE(nmf.brdf.evaluate(wi, wo, lobes.mean_colours).x, 0);
    }
    EXPECT_GT(svd.largest_negative, 0.01);
    EXPECT_NEAR(svd.largest_negative, -lowest / std::sqrt(norm / kCount),
                0.1 * svd.largest_negative);
    EXPECT_NEAR(svd.negative_norm, std::sqrt(negative / norm), 0.05 * svd.negative_norm);
}

TEST(Factorise, TakesABrdfThatIsNotReciprocal) {
    const BrdfLobes lobes = lobe_from([](const V3f& wi, const V3f& wo) {
        return std::exp(2 * wi.x * wo.x + 2 * wi.y * wo.y - wo.z) * (1 + 3 * wi.z * wi.z);
    });
    for (const Method method : {Method::svd, Method::nmf}) {
        const auto result = factorise("m", lobes, {.method = method, .terms = 8});
        EXPECT_LT(result.error, 0.2);
        EXPECT_NEAR(measured_error(lobes, result.brdf), result.error, 0.005);
    }
}

// A microfacet BRDF without masking, D/(4 cos θi cos θo), has no limit at grazing angles.
TEST(Factorise, IsFiniteAtGrazingAngles) {
    const BrdfLobes lobes = lobe_from(
        [](const V3f& wi, const V3f& wo) {
            const V3f half = (wi + wo).normalized();
            return std::pow(half.z, 40.0) / (4.0 * wi.z * wo.z);
        },
        0.15);
    for (const Method method : {Method::svd, Method::nmf}) {
        const auto result = factorise("m", lobes, {.method = method, .terms = 10});
        EXPECT_TRUE(std::isfinite(result.error));
        for (const double theta : {1.5, 1.57, 1.570796}) {
            const V3f value =
                result.brdf.evaluate(direction_from_angles(theta, 3.14159),
                                     direction_from_angles(theta, 0), lobes.mean_colours);
            EXPECT_TRUE(std::isfinite(value.x));
        }
    }
}

TEST(Factorise, MeasuredIsAsItsFormula) {
    const auto bytes =
        merl_file([](const V3f& wi, const V3f& wo) { return glossy().evaluate(wi, wo); });
    const BrdfLobes lobes = lobes_of(MerlBrdf("f", bytes));
    const auto measured = factorise("measured", lobes, {.terms = 7});
    EXPECT_EQ(measured.brdf.lobes, 3U);
    const auto formula = factorise("formula", glossy(), {.terms = 7});
    for (std::size_t k = 0; k < 7; ++k) {
        // Lobes apart in colour instead of diffuse and specular: the sums, and so what is best,
        // are not quite the same.
        EXPECT_NEAR(measured.errors[k], formula.errors[k], 0.02) << k;
    }
    EXPECT_NEAR(measured_error(lobes, measured.brdf), measured.error, 0.01);
}

// As many terms hold more of a sharp highlight in natural light, where the target that they
// miss in any light is met.
TEST(Factorise, MeetsATargetInNaturalLightThatItMissesInUncorrelatedLight) {
    const Bsdf bsdf = Bsdf::phong(V3f(0.2F), V3f(0.4F), 30);
    const auto uncorrelated = factorise("m", bsdf, {.target_error = 0.12});
    const auto natural =
        factorise("m", bsdf, {.light = LightModel::natural, .target_error = 0.12});
    EXPECT_FALSE(uncorrelated.meets_target);
    EXPECT_TRUE(natural.meets_target);
    EXPECT_LE(natural.brdf.terms, uncorrelated.brdf.terms);
    EXPECT_LT(natural.error, uncorrelated.error);
    EXPECT_TRUE(std::is_sorted(natural.errors.rbegin(), natural.errors.rend()));
}

TEST(Factorise, BlackAndOnlySpecularMaterialsHaveFactors) {
    for (const Bsdf& bsdf :
         {Bsdf::phong(V3f(0), V3f(0), 20), Bsdf::ggx(V3f(0), 1, 0.5F), Bsdf::lambert(V3f(0))}) {
        for (const Method method : {Method::svd, Method::nmf}) {
            const auto result = factorise("black", bsdf, {.method = method, .terms = 2});
            EXPECT_NO_THROW(require_valid(result.brdf));
            EXPECT_TRUE(std::isfinite(result.error));
        }
    }
}

TEST(Factorise, RefusesWhatItCannotDo) {
    const BrdfLobes lobes = lobes_of(glossy());
    for (const double target : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(static_cast<void>(factorise("m", lobes, {.target_error = target})),
                     FactorError);
    }
    for (const std::uint32_t terms : {0U, 17U}) {
        EXPECT_THROW(static_cast<void>(factorise("m", lobes, {.terms = terms})), FactorError);
        EXPECT_THROW(static_cast<void>(factorise("m", Bsdf::lambert(V3f(1)), {.terms = terms})),
                     FactorError);
    }
    EXPECT_THROW(static_cast<void>(factorise(
                     "m", lobes, {.method = Method::nmf, .light = LightModel::natural})),
                 FactorError);
    BrdfLobes none = lobes;
    none.mean_colours.clear();
    EXPECT_THROW(static_cast<void>(factorise("m", none)), FactorError);
    EXPECT_THROW(
        static_cast<void>(factorise("m", Bsdf::ggx(V3f(1), 1, 0.05F), {.method = Method::nmf})),
        FactorError);
}

}  // namespace
}  // namespace relume::factors
