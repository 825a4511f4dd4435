#include "precompute/factors/brdf_lobes.h"

#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relume::factors {
namespace {

using Imath::V3f;
using scene::Bsdf;

std::vector<Bsdf> bsdfs() {
    return {Bsdf::lambert({0.8F, 0.5F, 0.2F}),
            Bsdf::phong({0.3F, 0.2F, 0.1F}, {0.6F, 0.7F, 0.8F}, 42.5F),
            Bsdf::phong({0.9F, 0.9F, 0.9F}, {0.9F, 0.6F, 0.3F}, 200),
            Bsdf::phong({0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, 0),
            Bsdf::ggx({0.95F, 0.64F, 0.3F}, 1, 0.3F),
            Bsdf::ggx({0.4F, 0.7F, 0.9F}, 0.5F, 0.1F),
            Bsdf::ggx({1, 1, 1}, 0, 0.05F),
            Bsdf::ggx({1, 1, 1}, 0.3F, 0.5F, {.f0 = V3f(0.02F), .f90 = 0.5F})};
}

TEST(BrdfLobes, TimesTheirColoursAreTheBsdf) {
    CosineDirections directions(1);
    for (const Bsdf& bsdf : bsdfs()) {
        const BrdfLobes lobes = lobes_of(bsdf);
        ASSERT_EQ(lobes.count(), lobe_colours(bsdf).size());
        for (int i = 0; i < 2000; ++i) {
            const V3f wo = directions.next();
            // Every other pair near the mirror direction, where highlights are.
            const V3f wi =
                i % 2 == 0 ? directions.next()
                           : (V3f(-wo.x, -wo.y, wo.z) + directions.next() * 0.02F).normalized();
            const V3f expected = bsdf.evaluate(wi, wo);
            EXPECT_NEAR((colour_of(lobes, wi, wo) - expected).length(), 0,
                        1e-6F + 2e-6F * expected.length());
        }
    }
}

// What a texture says at one place is the place's colours times the lobes of all places.
TEST(BrdfLobes, AreThoseOfEveryPlaceOfATexturedSurface) {
    const std::vector<Bsdf> places{Bsdf::ggx({0.9F, 0.1F, 0.4F}, 0, 0.4F),
                                   Bsdf::ggx({0.2F, 0.8F, 0.4F}, 1, 0.4F),
                                   Bsdf::ggx({0.5F, 0.5F, 0.1F}, 0.25F, 0.4F)};
    const BrdfLobes lobes = lobes_of(places[0].with_mean_colours(places));
    CosineDirections directions(2);
    for (const Bsdf& place : places) {
        BrdfLobes of_place = lobes;
        of_place.mean_colours = lobe_colours(place);
        for (int i = 0; i < 200; ++i) {
            const V3f wi = directions.next();
            const V3f wo = directions.next();
            const V3f expected = place.evaluate(wi, wo);
            EXPECT_NEAR((colour_of(of_place, wi, wo) - expected).length(), 0,
                        1e-6F + 2e-6F * expected.length());
        }
    }
}

TEST(BrdfLobes, AreIsotropicEvenAndFiniteUpToTheHorizon) {
    CosineDirections directions(3);
    for (const Bsdf& bsdf : bsdfs()) {
        const BrdfLobes lobes = lobes_of(bsdf);
        for (int i = 0; i < 200; ++i) {
            const V3f wi = directions.next();
            const V3f wo = directions.next();
            const auto values = values_of(lobes, wi, wo);
            const auto around = values_of(lobes, turned(wi, 1.1), turned(wo, 1.1));
            const auto mirrored = values_of(lobes, {wi.x, -wi.y, wi.z}, {wo.x, -wo.y, wo.z});
            for (std::size_t l = 0; l < values.size(); ++l) {
                EXPECT_NEAR(around[l], values[l], 1e-4F + 2e-4F * values[l]);
                EXPECT_NEAR(mirrored[l], values[l], 1e-5F + 1e-5F * values[l]);
            }
        }
        for (const double grazing : {1.5, 1.57, 1.5707}) {
            for (const double azimuth : {0.0, 1.0, 3.14159}) {
                for (const float value :
                     values_of(lobes, direction_from_angles(grazing, azimuth),
                               direction_from_angles(grazing, 0))) {
                    EXPECT_TRUE(std::isfinite(value) && value >= 0) << value;
                }
            }
        }
    }
}

TEST(BrdfLobes, WeighAsTheirColours) {
    const auto weights = lobes_of(Bsdf::phong({0.3F, 0, 0.4F}, V3f(0.2F), 10)).weights();
    EXPECT_NEAR(weights[0], std::sqrt(0.25 / 3), 1e-7);
    EXPECT_NEAR(weights[1], 0.2, 1e-7);
    EXPECT_EQ(lobes_of(Bsdf::phong(V3f(0), V3f(0), 10)).weights(), (std::vector<double>{1, 1}));
    EXPECT_EQ(lobes_of(Bsdf::phong(V3f(0), V3f(1), 10)).weights(), (std::vector<double>{0, 1}));
}

}  // namespace
}  // namespace relume::factors
