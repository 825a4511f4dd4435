#include "protocol/brdf/factored_brdf.h"

#include "protocol/brdf/error.h"
#include "tests/unit/brdf/brdfs.h"
#include "tests/unit/brdf/random_directions.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace relume::brdf {
namespace {

using Imath::V3f;

TEST(FactoredBrdf, IsTheSumOverTermsAndLobes) {
    const FactoredBrdf brdf = random_brdf("any", 3, 2);
    const std::array<V3f, 2> colours{V3f(0.1F, 0.5F, 0.9F), V3f(1, 0, 0.25F)};
    RandomDirections random(5);
    for (int i = 0; i < 50; ++i) {
        const V3f wi = random.above_horizon();
        const V3f wo = random.above_horizon();
        std::array<float, 3> g{};
        std::array<float, 6> h{};
        brdf.g.evaluate(wi, g);
        brdf.h.evaluate(wo, h);
        V3f expected(0, 0, 0);
        for (std::size_t k = 0; k < 3; ++k) {
            expected += (colours[0] * h[2 * k] + colours[1] * h[2 * k + 1]) * g[k];
        }
        EXPECT_NEAR((brdf.evaluate(wi, wo, colours) - expected).length(), 0, 1e-5F);
    }
}

TEST(FactoredBrdf, LambertIsItsAlbedoOverPi) {
    for (const V3f& albedo : {V3f(0.5F), V3f(0.8F, 0.2F, 0.1F), V3f(0)}) {
        const FactoredBrdf brdf = factored_lambert("matt", albedo);
        require_valid(brdf);
        RandomDirections random(6);
        for (int i = 0; i < 50; ++i) {
            const std::array<V3f, 1> colours{albedo};
            const V3f value =
                brdf.evaluate(random.above_horizon(), random.above_horizon(), colours);
            EXPECT_NEAR((value - albedo / std::numbers::pi_v<float>).length(), 0, 1e-6F);
        }
        EXPECT_EQ(brdf.evaluate({0, 0.6F, -0.8F}, {0, 0, 1}, std::array<V3f, 1>{albedo}),
                  V3f(0));
        EXPECT_EQ(brdf.evaluate({0, 0, 1}, {0, 0.6F, -0.8F}, std::array<V3f, 1>{albedo}),
                  V3f(0));
    }
}

TEST(FactoredBrdf, RefusesCountsAndNamesThatItCannotStore) {
    EXPECT_NO_THROW(require_valid(random_brdf(std::string(255, 'x'), 16, 4)));
    EXPECT_THROW(require_valid(random_brdf(std::string(256, 'x'), 1, 1)), BrdfError);
    EXPECT_THROW(require_valid(random_brdf("two\nlines", 1, 1)), BrdfError);
    EXPECT_THROW(require_valid(random_brdf("", 17, 1)), BrdfError);
    EXPECT_THROW(require_valid(random_brdf("", 1, 5)), BrdfError);
    FactoredBrdf brdf = random_brdf("", 2, 2);
    brdf.terms = 1;
    EXPECT_THROW(require_valid(brdf), BrdfError);
    brdf = random_brdf("", 2, 2);
    brdf.lobes = 1;
    EXPECT_THROW(require_valid(brdf), BrdfError);
}

}  // namespace
}  // namespace relume::brdf
