#include "protocol/light/background.h"

#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

using namespace testing;

TEST(Background, IsTheSourceItselfTurnedAndScaled) {
    // A stripe pattern that 8² texels of lighting could never hold.
    const Radiance stripes = [](const Imath::V3f& d) {
        return Imath::V3f(2 + std::sin(40 * d.y), 1, 2 + std::cos(30 * d.x));
    };
    LightRig rig;
    rig.environment = std::make_shared<PrefilteredEnvironment>(lat_long_map(512, stripes), 8);
    rig.environment_scale = {1, 2, 0.5F};
    std::mt19937 generator(1);
    rig.rotation = random_rotation(generator);
    const Background background(rig);
    for (int i = 0; i < 500; ++i) {
        const Imath::V3f source = random_direction(generator);
        const Imath::V3f world = rig.rotation.rotateVector(source);
        const Imath::V3f shown = background.radiance(world * 5.0F, 1e-7F);
        EXPECT_LT((shown - rig.environment_scale * stripes(source)).length(), 0.03F);
        EXPECT_EQ(shown, background_radiance(rig, world * 5.0F, 1e-7F));
    }
}

TEST(Background, ShowsTheEnergyThatTheLightingGets) {
    LightRig rig;
    rig.environment =
        std::make_shared<PrefilteredEnvironment>(lat_long_map(64, smooth_radiance), 16);
    rig.lights.push_back({{0.2F, 1, 0.5F}, 0.4F, {5, 1, 2}});
    std::mt19937 generator(2);
    rig.rotation = random_rotation(generator);
    LightCubemap cubemap;
    evaluate(rig, 16, cubemap);
    const Background background(rig);
    Imath::V3d sum(0);
    constexpr int kDirections = 100000;
    for (int i = 0; i < kDirections; ++i) {
        sum += Imath::V3d(background.radiance(random_direction(generator), 1e-5F));
    }
    const Imath::V3d shown = sum * (4 * std::numbers::pi / kDirections);
    const Imath::V3d given = total_energy(cubemap);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(shown[c] / given[c], 1, 0.01);
    }
}

TEST(Background, DiscsAreRoundEvenAndSharp) {
    LightRig rig;
    constexpr float kRadius = 0.1F;
    rig.lights.push_back({{0, 0, -3}, kRadius, {7, 8, 9}});
    const Background background(rig);
    constexpr float kPixel = 1e-3F;
    for (int i = 0; i < 360; ++i) {
        const float turn = static_cast<float>(i) * std::numbers::pi_v<float> / 180;
        const auto at = [&](float angle) {
            return background.radiance({std::sin(angle) * std::cos(turn),
                                        std::sin(angle) * std::sin(turn), -std::cos(angle)},
                                       kPixel * kPixel);
        };
        EXPECT_EQ(at(kRadius - kPixel), Imath::V3f(7, 8, 9));
        EXPECT_EQ(at(kRadius + kPixel), Imath::V3f(0));
        EXPECT_NEAR(at(kRadius).x, 3.5F, 0.1F);
    }
}

TEST(Background, DiscsKeepTheirEnergyAtAnyPixelSize) {
    // Sum over a grid of pixels on the plane z = −1, near its centre.
    for (const float radius : {2e-4F, 1e-3F, 4e-3F, 0.02F}) {
        LightRig rig;
        rig.lights.push_back({{0.0103F, -0.0071F, -1}, radius, {1, 1, 1}});
        const Background background(rig);
        constexpr float kPixel = 2e-3F;
        double energy = 0;
        for (int y = -40; y <= 40; ++y) {
            for (int x = -40; x <= 40; ++x) {
                const Imath::V3f d(static_cast<float>(x) * kPixel,
                                   static_cast<float>(y) * kPixel, -1);
                const float footprint = kPixel * kPixel / std::pow(d.length(), 3.0F);
                energy += double{footprint} * double{background.radiance(d, footprint).x};
            }
        }
        // One sample a pixel of a cone two pixels wide leaves some ripple.
        const double expected = solid_angle_sr(rig.lights.front());
        EXPECT_NEAR(energy / expected, 1, 0.12) << radius;
    }
}

}  // namespace
}  // namespace relume::light
