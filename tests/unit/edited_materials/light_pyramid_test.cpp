// The light at every resolution: means of what is finer.
#include "server/materials/light_pyramid.h"

#include "protocol/basis/cubemap.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace relume::materials {
namespace {

constexpr float kSphere = 4 * std::numbers::pi_v<float>;

light::LightCubemap random_light(std::uint32_t n) {
    light::LightCubemap light(n);
    std::mt19937_64 random(n);
    std::exponential_distribution<float> value(1);
    for (float& radiance : light.radiance) {
        radiance = value(random);
    }
    return light;
}

TEST(LightPyramid, ANarrowLookIsTheTexelItself) {
    const light::LightCubemap light = random_light(8);
    const LightPyramid pyramid(light);
    for (std::size_t texel = 0; texel < light.plane_size(); ++texel) {
        const Imath::V3f direction =
            basis::direction_from_texel(8, basis::texel_from_index(8, texel));
        const Imath::V3f found = pyramid.radiance(direction, 1e-6F);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(found[c], light.planes()[static_cast<std::size_t>(c)][texel]);
        }
    }
}

TEST(LightPyramid, AWideLookIsTheMeanOfTheFace) {
    const light::LightCubemap light = random_light(8);
    const LightPyramid pyramid(light);
    double sum = 0;
    for (std::size_t texel = 0; texel < 64; ++texel) {
        sum += double{light.planes()[1][texel]};
    }
    const Imath::V3f inside = basis::direction_from_texel(8, basis::texel_from_index(8, 9));
    EXPECT_NEAR(pyramid.radiance(inside, kSphere).y, sum / 64, 1e-5);
}

TEST(LightPyramid, EveryLevelHasTheMeanOfAllTexels) {
    const light::LightCubemap light = random_light(16);
    const LightPyramid pyramid(light);
    double mean = 0;
    const auto planes = light.planes();
    for (const float radiance : planes[0]) {
        mean += double{radiance} / static_cast<double>(light.plane_size());
    }
    for (std::uint32_t n = 1; n <= 16; n *= 2) {
        const std::size_t texels = std::size_t{6} * n * n;
        double sum = 0;
        for (std::size_t texel = 0; texel < texels; ++texel) {
            const Imath::V3f direction =
                basis::direction_from_texel(n, basis::texel_from_index(n, texel));
            sum += double{pyramid.radiance(direction, kSphere / static_cast<float>(texels)).x};
        }
        EXPECT_NEAR(sum / static_cast<double>(texels), mean, 1e-5) << n;
    }
}

}  // namespace
}  // namespace relume::materials
