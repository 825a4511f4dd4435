#include "protocol/light/area_light.h"

#include "protocol/basis/cubemap.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

using namespace testing;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

LightCubemap lit(const AreaLight& light, std::uint32_t n) {
    LightCubemap cubemap(n);
    add_area_light(light, cubemap);
    return cubemap;
}

// ∫ |difference| dω over ∫ b dω.
double relative_l1(const LightCubemap& a, const LightCubemap& b) {
    LightCubemap difference = a;
    for (std::size_t i = 0; i < a.radiance.size(); ++i) {
        difference.radiance[i] = std::abs(a.radiance[i] - b.radiance[i]);
    }
    return total_energy(difference).x / total_energy(b).x;
}

TEST(AreaLight, EnergyIsRadianceTimesSolidAngleEverywhere) {
    std::mt19937 generator(1);
    for (const std::uint32_t n : {4U, 16U, 64U}) {
        for (const float degrees : {0.05F, 0.5F, 5.0F, 30.0F, 90.0F}) {
            for (int i = 0; i < 6; ++i) {
                const AreaLight light{
                    random_direction(generator) * 7.0F, degrees * kDegree, {1, 20, 300}};
                const Imath::V3d energy = total_energy(lit(light, n));
                const double expected =
                    2 * std::numbers::pi *
                    (1 - std::cos(double{degrees} * std::numbers::pi / 180));
                EXPECT_NEAR(energy.x / expected, 1, 1e-4) << n << " " << degrees;
                EXPECT_NEAR(energy.z / expected, 300, 0.03) << n << " " << degrees;
            }
        }
    }
}

TEST(AreaLight, InsideOfALargeLightIsItsRadianceAndOutsideIsBlack) {
    constexpr std::uint32_t kN = 64;
    const AreaLight light{{1, 1, 0.2F}, 25 * kDegree, {3, 3, 3}};
    const LightCubemap cubemap = lit(light, kN);
    for (std::size_t texel = 0; texel < cubemap.plane_size(); ++texel) {
        const Imath::V3f d =
            basis::direction_from_texel(kN, basis::texel_from_index(kN, texel));
        const float angle =
            std::acos(std::clamp(d.dot(light.direction.normalized()), -1.0F, 1.0F));
        if (angle < 21 * kDegree) {
            EXPECT_NEAR(cubemap.radiance[texel], 3.0F, 0.01F);
        } else if (angle > 29 * kDegree) {
            EXPECT_EQ(cubemap.radiance[texel], 0.0F);
        }
    }
}

TEST(AreaLight, MovesWithoutJumpsAcrossTexelsEdgesAndCorners) {
    // Paths over the middle of a face, an edge and a corner, in steps of a hundredth of a
    // texel: each step may change the lighting only by about that much.
    constexpr std::uint32_t kN = 16;
    const std::pair<Imath::V3f, Imath::V3f> paths[] = {{{1, 0.01F, -0.02F}, {0, 0.3F, 1}},
                                                       {{1, 0.03F, 1}, {-1, 0.1F, 1}},
                                                       {{1, 1, 1}, {1, -1, 0.2F}},
                                                       {{-1, -1, 1}, {1, 0, 0.9F}}};
    for (const float degrees : {0.05F, 1.0F, 8.0F}) {
        for (const auto& [place, along] : paths) {
            LightCubemap before;
            for (int step = -200; step <= 200; ++step) {
                const float offset = static_cast<float>(step) * 0.01F * 2 / kN;
                const LightCubemap now = lit({place + offset * along, degrees * kDegree}, kN);
                if (step > -200) {
                    EXPECT_LT(relative_l1(now, before), 0.08)
                        << degrees << " degrees at " << place << ", step " << step;
                }
                before = now;
            }
        }
    }
}

TEST(AreaLight, GrowsWithoutJumps) {
    constexpr std::uint32_t kN = 16;
    const Imath::V3f direction(0.3F, 1, 0.7F);
    LightCubemap before = lit({direction, 0.05F * kDegree}, kN);
    for (float degrees = 0.05F; degrees < 88; degrees *= 1.01F) {
        const LightCubemap now = lit({direction, 1.01F * degrees * kDegree}, kN);
        EXPECT_LT(relative_l1(now, before), 0.05) << degrees;
        before = now;
    }
}

TEST(AreaLight, AddsToWhatIsThere) {
    const AreaLight one{{0, 1, 0}, 0.3F, {1, 2, 3}};
    const AreaLight other{{1, 0, 0}, 0.01F, {5, 5, 5}};
    LightCubemap both = lit(one, 8);
    add_area_light(other, both);
    const LightCubemap first = lit(one, 8);
    const LightCubemap second = lit(other, 8);
    for (std::size_t i = 0; i < both.radiance.size(); ++i) {
        EXPECT_FLOAT_EQ(both.radiance[i], first.radiance[i] + second.radiance[i]);
    }
}

}  // namespace
}  // namespace relume::light
