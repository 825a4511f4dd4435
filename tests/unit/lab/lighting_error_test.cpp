// The L1 error of lighting, by solid angle.
#include "tests/lab/measures/lighting_error.h"

#include "protocol/basis/cubemap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace relume::lab {
namespace {

constexpr std::uint32_t kResolution = 8;

light::LightCubemap constant(float radiance) {
    light::LightCubemap cubemap(kResolution);
    std::fill(cubemap.radiance.begin(), cubemap.radiance.end(), radiance);
    return cubemap;
}

TEST(LightingError, OfConstantLightsIsTheirRelativeDifference) {
    const LightingError error(kResolution);
    EXPECT_NEAR(error.relative_l1(constant(3), constant(4)), 0.25, 1e-12);
    EXPECT_EQ(error.relative_l1(constant(4), constant(4)), 0);
    EXPECT_EQ(error.relative_l1(constant(0), constant(0)), 0);
    EXPECT_EQ(error.relative_l1(constant(1), constant(0)), 1);
}

TEST(LightingError, WeighsATexelByItsSolidAngle) {
    const LightingError error(kResolution);
    const light::LightCubemap target = constant(1);
    for (const std::uint32_t row : {0U, 3U}) {
        light::LightCubemap shown = target;
        const basis::Texel texel{.face = basis::Face::positive_z, .row = row, .column = 2};
        shown.planes()[1][basis::index_from_texel(kResolution, texel)] += 1;
        const double expected =
            basis::solid_angle_sr(kResolution, row, 2) / (3 * 4 * std::numbers::pi);
        EXPECT_NEAR(error.relative_l1(shown, target), expected, 1e-9);
    }
}

TEST(LightingError, RefusesAnotherResolution) {
    const LightingError error(2 * kResolution);
    EXPECT_THROW((void)error.relative_l1(constant(1), constant(1)), std::invalid_argument);
}

}  // namespace
}  // namespace relume::lab
