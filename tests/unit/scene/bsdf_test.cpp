// The laws every reflection model keeps: reciprocity, energy, sampling that agrees with its
// density, one direction and many giving the same bits.
#include "precompute/scene/bsdf.h"

#include "tests/support/reference_tracer/random.h"
#include "tests/support/reference_tracer/reflection.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

using reference::Random;

constexpr double kPi = std::numbers::pi;

struct NamedBsdf {
    std::string name;
    Bsdf bsdf;
};

std::ostream& operator<<(std::ostream& out, const NamedBsdf& named) {
    return out << named.name;
}

std::vector<NamedBsdf> all_bsdfs() {
    return {
        {"lambert", Bsdf::lambert({0.8F, 0.5F, 0.2F})},
        {"lambert_white", Bsdf::lambert({1, 1, 1})},
        {"phong_broad", Bsdf::phong({0.3F, 0.2F, 0.1F}, {0.6F, 0.7F, 0.8F}, 3)},
        {"phong_narrow", Bsdf::phong({0.2F, 0.3F, 0.4F}, {0.5F, 0.5F, 0.5F}, 42.5F)},
        {"phong_too_bright", Bsdf::phong({0.9F, 0.9F, 0.9F}, {0.9F, 0.6F, 0.3F}, 20)},
        {"phong_mirror_only", Bsdf::phong({0, 0, 0}, {1, 1, 1}, 80)},
        {"ggx_white_rough", Bsdf::ggx({1, 1, 1}, 0, 1)},
        {"ggx_white_half", Bsdf::ggx({1, 1, 1}, 0, 0.6F)},
        {"ggx_white_smooth", Bsdf::ggx({1, 1, 1}, 0, 0.35F)},
        {"ggx_metal", Bsdf::ggx({0.95F, 0.64F, 0.3F}, 1, 0.5F)},
        {"ggx_half_metal", Bsdf::ggx({0.4F, 0.7F, 0.9F}, 0.5F, 0.4F)},
        {"ggx_diamond", Bsdf::ggx({1, 1, 1}, 0, 0.4F, {.f0 = Imath::V3f(0.172F)})},
        {"ggx_tinted", Bsdf::ggx({1, 1, 1}, 0, 0.5F, {.f0 = {0.4F, 0, 0}})},
        {"ggx_half_specular",
         Bsdf::ggx({1, 1, 1}, 0.3F, 0.5F, {.f0 = Imath::V3f(0.02F), .f90 = 0.5F})},
        {"ggx_no_specular", Bsdf::ggx({1, 1, 1}, 0, 0.5F, {.f0 = Imath::V3f(0), .f90 = 0})},
        {"ggx_mirror_coat", Bsdf::ggx({1, 1, 1}, 0, 0.5F, {.f0 = Imath::V3f(1)})},
    };
}

Imath::V3f direction(double cosine, double phi) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
            static_cast<float>(cosine)};
}

Imath::V3f any_direction(Random& random) {
    return direction(0.02 + 0.98 * random.uniform(), 2.0 * kPi * random.uniform());
}

float uniform(Random& random) {
    return static_cast<float>(random.uniform());
}

// ∫ value(wi) dω over the hemisphere by midpoints.
template <typename Value>
auto hemisphere_integral(Value value) {
    constexpr int kZ = 240;
    constexpr int kPhi = 240;
    auto sum = value(Imath::V3f(0, 0, 1)) * 0.0;
    for (int i = 0; i < kZ; ++i) {
        for (int j = 0; j < kPhi; ++j)
            sum += value(direction((i + 0.5) / kZ, 2.0 * kPi * (j + 0.5) / kPhi)) *
                   (2.0 * kPi / (kZ * kPhi));
    }
    return sum;
}

class EveryBsdf : public testing::TestWithParam<NamedBsdf> {};

INSTANTIATE_TEST_SUITE_P(Models,
                         EveryBsdf,
                         testing::ValuesIn(all_bsdfs()),
                         [](const auto& param_info) { return param_info.param.name; });

TEST_P(EveryBsdf, IsReciprocalAndNotNegative) {
    const Bsdf& bsdf = GetParam().bsdf;
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const Imath::V3f a = any_direction(random);
        const Imath::V3f b = any_direction(random);
        const Imath::V3f there = bsdf.evaluate(a, b);
        const Imath::V3f back = bsdf.evaluate(b, a);
        for (int c = 0; c < 3; ++c) {
            ASSERT_GE(there[c], 0.0F);
            ASSERT_NEAR(there[c], back[c], 1e-3F * there[c] + 1e-6F);
        }
    }
}

TEST_P(EveryBsdf, ReflectsNoMoreThanItReceives) {
    const Bsdf& bsdf = GetParam().bsdf;
    for (const double cosine : {1.0, 0.9, 0.7, 0.5, 0.3, 0.15, 0.06}) {
        const Imath::V3f wo = direction(cosine, 0.7);
        const Imath::V3d reflected = hemisphere_integral([&](const Imath::V3f& wi) {
            return Imath::V3d(bsdf.evaluate(wi, wo)) * double{wi.z};
        });
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(reflected[c], 1.003) << "channel " << c << " at cosine " << cosine;
    }
}

TEST_P(EveryBsdf, AgreesWithTheReferenceFormula) {
    const Bsdf& bsdf = GetParam().bsdf;
    reference::Reflection reflection;
    reflection.model = static_cast<reference::Reflection::Model>(bsdf.model());
    reflection.diffuse = Imath::V3d(bsdf.diffuse_colour());
    reflection.specular = Imath::V3d(bsdf.specular_colour());
    reflection.exponent = bsdf.exponent();
    reflection.alpha = bsdf.alpha();
    reflection.grazing = bsdf.grazing();
    reflection.coat_f0 = bsdf.coat().f0;
    reflection.coat_f90 = bsdf.coat().f90;
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const Imath::V3f wi = any_direction(random);
        const Imath::V3f wo = any_direction(random);
        const Imath::V3f ours = bsdf.evaluate(wi, wo);
        const Imath::V3d theirs = reflection.value(Imath::V3d(wi), Imath::V3d(wo));
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(ours[c], theirs[c], 2e-4 * theirs[c] + 1e-6);
    }
}

TEST_P(EveryBsdf, DensityIntegratesToTheChanceOfASample) {
    const Bsdf& bsdf = GetParam().bsdf;
    constexpr int kSamples = 200000;
    for (const double cosine : {1.0, 0.6, 0.2}) {
        const Imath::V3f wo = direction(cosine, 2.0);
        const double integral = hemisphere_integral(
            [&](const Imath::V3f& wi) { return static_cast<double>(bsdf.pdf(wi, wo)); });
        Random random(3);
        int above = 0;
        for (int i = 0; i < kSamples; ++i) {
            const auto sample =
                bsdf.sample(wo, uniform(random), {uniform(random), uniform(random)});
            above += sample.pdf > 0 ? 1 : 0;
        }
        const double share = static_cast<double>(above) / kSamples;
        EXPECT_NEAR(integral, share, 5.0 * std::sqrt(0.25 / kSamples)) << "cosine " << cosine;
        if (bsdf.is_diffuse()) {
            EXPECT_EQ(above, kSamples);
        }
    }
}

TEST_P(EveryBsdf, WeightIsValueTimesCosineOverDensity) {
    const Bsdf& bsdf = GetParam().bsdf;
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const Imath::V3f wo = any_direction(random);
        const auto sample =
            bsdf.sample(wo, uniform(random), {uniform(random), uniform(random)});
        ASSERT_NEAR(sample.wi.length(), 1.0F, 1e-3F);
        ASSERT_EQ(sample.pdf, bsdf.pdf(sample.wi, wo));
        const Imath::V3f expected = bsdf.evaluate(sample.wi, wo) * sample.wi.z;
        for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(sample.weight[c]));
            ASSERT_NEAR(sample.weight[c] * sample.pdf, expected[c],
                        1e-4F * expected[c] + 1e-7F);
        }
    }
}

// Pearson's χ² over a grid of the hemisphere, cells pooled until each expects five samples.
TEST_P(EveryBsdf, SamplesAreDistributedAsTheirDensity) {
    constexpr int kZ = 10;
    constexpr int kPhi = 20;
    constexpr int kFine = 12;
    constexpr int kSamples = 100000;
    const Bsdf& bsdf = GetParam().bsdf;
    for (const double cosine : {0.95, 0.4}) {
        const Imath::V3f wo = direction(cosine, 1.0);
        std::vector<double> expected(kZ * kPhi);
        for (int i = 0; i < kZ * kFine; ++i) {
            for (int j = 0; j < kPhi * kFine; ++j) {
                const Imath::V3f wi =
                    direction((i + 0.5) / (kZ * kFine), 2.0 * kPi * (j + 0.5) / (kPhi * kFine));
                expected[static_cast<std::size_t>(i / kFine * kPhi + j / kFine)] +=
                    bsdf.pdf(wi, wo) * 2.0 * kPi / (kZ * kPhi * kFine * kFine) * kSamples;
            }
        }
        std::vector<double> found(kZ * kPhi);
        Random random(5);
        for (int i = 0; i < kSamples; ++i) {
            const auto sample =
                bsdf.sample(wo, uniform(random), {uniform(random), uniform(random)});
            if (sample.pdf <= 0)
                continue;
            double phi = std::atan2(sample.wi.y, sample.wi.x) / (2.0 * kPi);
            phi -= std::floor(phi);
            const int row = std::min(kZ - 1, static_cast<int>(sample.wi.z * kZ));
            const int column = std::min(kPhi - 1, static_cast<int>(phi * kPhi));
            found[static_cast<std::size_t>(row * kPhi + column)] += 1;
        }
        double chi2 = 0;
        int cells = 0;
        double pooled_expected = 0;
        double pooled_found = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            pooled_expected += expected[i];
            pooled_found += found[i];
            if (pooled_expected < 5)
                continue;
            chi2 += std::pow(pooled_found - pooled_expected, 2.0) / pooled_expected;
            ++cells;
            pooled_expected = pooled_found = 0;
        }
        // One test in ten thousand would fail by chance; the seed is fixed, so none does.
        const boost::math::chi_squared distribution(cells);
        EXPECT_LT(chi2, quantile(complement(distribution, 1e-4)))
            << cells << " cells, cosine " << cosine;
    }
}

TEST_P(EveryBsdf, ManyDirectionsGiveTheBitsOfOne) {
    const Bsdf& bsdf = GetParam().bsdf;
    Random random(6);
    for (const std::size_t count : {1U, 3U, 63U, 64U, 65U, 200U}) {
        std::vector<float> x;
        std::vector<float> y;
        std::vector<float> z;
        for (std::size_t i = 0; i < count; ++i) {
            Imath::V3f wi = any_direction(random);
            if (i % 5 == 4)
                wi.z = -wi.z;
            x.push_back(wi.x);
            y.push_back(wi.y);
            z.push_back(wi.z);
        }
        const Imath::V3f wo = any_direction(random);
        std::vector<float> r(count, -1);
        std::vector<float> g(count, -1);
        std::vector<float> b(count, -1);
        bsdf.evaluate_times_cosine(wo, {x, y, z}, {r, g, b});
        for (std::size_t i = 0; i < count; ++i) {
            float one[3];
            bsdf.evaluate_times_cosine(wo, {{&x[i], 1}, {&y[i], 1}, {&z[i], 1}},
                                       {{&one[0], 1}, {&one[1], 1}, {&one[2], 1}});
            ASSERT_EQ(r[i], one[0]);
            ASSERT_EQ(g[i], one[1]);
            ASSERT_EQ(b[i], one[2]);
            const Imath::V3f value = bsdf.evaluate({x[i], y[i], z[i]}, wo);
            ASSERT_NEAR(r[i], value.x * std::max(z[i], 0.0F), 1e-6F + 1e-6F * r[i]);
            if (z[i] <= 0) {
                ASSERT_EQ(r[i], 0.0F);
            }
        }
    }
}

TEST_P(EveryBsdf, IsItsColoursTimesItsLobes) {
    const Bsdf& bsdf = GetParam().bsdf;
    Random random(17);
    constexpr std::size_t kCount = 130;
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> z;
    for (std::size_t i = 0; i < kCount; ++i) {
        const Imath::V3f wi = any_direction(random);
        x.push_back(wi.x);
        y.push_back(wi.y);
        z.push_back(i % 5 == 4 ? -wi.z : wi.z);
    }
    for (const float sign : {1.0F, -1.0F}) {
        Imath::V3f wo = any_direction(random);
        wo.z *= sign;
        std::vector<float> diffuse(kCount, -1);
        std::vector<float> specular(kCount, -1);
        std::vector<float> grazing(kCount, -1);
        bsdf.evaluate_lobes_times_cosine(wo, {x, y, z}, {diffuse, specular, grazing});
        for (std::size_t i = 0; i < kCount; ++i) {
            const Imath::V3f value = bsdf.diffuse_colour() * diffuse[i] +
                                     bsdf.specular_colour() * specular[i] +
                                     Imath::V3f(bsdf.grazing() * grazing[i]);
            const Imath::V3f expected =
                bsdf.evaluate({x[i], y[i], z[i]}, wo) * std::max(z[i], 0.0F);
            ASSERT_NEAR((value - expected).length(), 0, 1e-6F + 1e-5F * expected.length());
            ASSERT_GE(std::min({diffuse[i], specular[i], grazing[i]}), 0);
        }
    }
}

TEST_P(EveryBsdf, IsBlackBelowTheHorizon) {
    const Bsdf& bsdf = GetParam().bsdf;
    const Imath::V3f above = direction(0.5, 1);
    const Imath::V3f below(above.x, above.y, -above.z);
    EXPECT_EQ(bsdf.evaluate(below, above), Imath::V3f(0));
    EXPECT_EQ(bsdf.evaluate(above, below), Imath::V3f(0));
    EXPECT_EQ(bsdf.pdf(below, above), 0.0F);
    EXPECT_EQ(bsdf.pdf(above, below), 0.0F);
    EXPECT_EQ(bsdf.sample(below, 0.5F, {0.5F, 0.5F}).weight, Imath::V3f(0));
}

TEST(Bsdf, OfMeanColoursIsTheMean) {
    const std::vector<Bsdf> places{Bsdf::ggx({0.9F, 0.5F, 0.1F}, 0, 0.3F),
                                   Bsdf::ggx({0.1F, 0.1F, 0.2F}, 0, 0.3F),
                                   Bsdf::ggx({0.5F, 0.7F, 0.6F}, 1, 0.3F)};
    const Bsdf mean = places[0].with_mean_colours(places);
    const Imath::V3f wo = Imath::V3f(0.3F, -0.2F, 0.6F).normalized();
    for (const Imath::V3f& towards :
         {Imath::V3f(-0.3F, 0.2F, 0.6F), Imath::V3f(0.9F, 0, 0.2F), Imath::V3f(0, 0, 1)}) {
        const Imath::V3f wi = towards.normalized();
        Imath::V3f sum{0, 0, 0};
        for (const Bsdf& place : places) {
            sum += place.evaluate(wi, wo) / 3.0F;
        }
        const Imath::V3f value = mean.evaluate(wi, wo);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(value[c], sum[c], 1e-5F * sum[c]);
        }
    }
}

TEST(Bsdf, LambertReflectsExactlyItsAlbedo) {
    const Bsdf bsdf = Bsdf::lambert({0.8F, 0.5F, 0.2F});
    Random random(7);
    for (int i = 0; i < 100; ++i) {
        const auto sample = bsdf.sample(any_direction(random), uniform(random),
                                        {uniform(random), uniform(random)});
        EXPECT_NEAR(sample.weight.x, 0.8F, 1e-5F);
        EXPECT_NEAR(sample.weight.y, 0.5F, 1e-5F);
        EXPECT_NEAR(sample.weight.z, 0.2F, 1e-5F);
    }
    EXPECT_TRUE(bsdf.is_diffuse());
    EXPECT_FALSE(Bsdf::ggx({1, 1, 1}, 0, 1).is_diffuse());
}

TEST(Bsdf, PhongIsNormalisedAtNormalIncidence) {
    for (const float exponent : {0.0F, 1.0F, 2.5F, 10.0F, 60.25F}) {
        const Bsdf bsdf = Bsdf::phong({0, 0, 0}, {1, 1, 1}, exponent);
        const Imath::V3f wo(0, 0, 1);
        const double reflected = hemisphere_integral([&](const Imath::V3f& wi) {
            return static_cast<double>(bsdf.evaluate(wi, wo).x) * double{wi.z};
        });
        EXPECT_NEAR(reflected, 1.0, 5e-3) << exponent;
    }
}

TEST(Bsdf, SmoothestGgxKeepsItsEnergy) {
    // Too narrow for a grid; its own samples integrate it. Without masking at normal incidence
    // a smooth metal reflects all it receives.
    const Bsdf bsdf = Bsdf::ggx({1, 1, 1}, 1, 0);
    Random random(8);
    double sum = 0;
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i)
        sum += bsdf.sample({0, 0, 1}, uniform(random), {uniform(random), uniform(random)})
                   .weight.x;
    EXPECT_NEAR(sum / kSamples, 1.0, 2e-3);
}

TEST(Bsdf, ColoursAndParametersAreBounded) {
    const float nan = std::nanf("");
    EXPECT_EQ(Bsdf::lambert({2, -1, nan}).diffuse_colour(), Imath::V3f(1, 0, 0));
    EXPECT_EQ(Bsdf::phong({0, 0, 0}, {1, 1, 1}, nan).exponent(), 0.0F);
    EXPECT_EQ(Bsdf::ggx({1, 1, 1}, 0, 0).alpha(), Bsdf::kMinRoughness * Bsdf::kMinRoughness);
    const Bsdf bright = Bsdf::phong({0.9F, 0.9F, 0.9F}, {0.9F, 0.6F, 0.3F}, 20);
    EXPECT_NEAR(bright.diffuse_colour().x + bright.specular_colour().x, 1.0F, 1e-6F);
}

// Without a specular share the layer below has no coat: Lambert is left.
TEST(Bsdf, DielectricOfNoReflectanceIsMatte) {
    const Imath::V3f colour(0.8F, 0.5F, 0.2F);
    const Bsdf bare = Bsdf::ggx(colour, 0, 0.5F, {.f0 = Imath::V3f(0), .f90 = 0});
    const Imath::V3f wi = direction(0.3, 1.0);
    const Imath::V3f wo = direction(0.6, 4.0);
    const Imath::V3f apart = bare.evaluate(wi, wo) - Bsdf::lambert(colour).evaluate(wi, wo);
    EXPECT_LT(apart.length(), 1e-6F);
}

}  // namespace
}  // namespace relume::scene
