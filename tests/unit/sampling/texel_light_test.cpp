// Directions drawn where a light is bright.
#include "protocol/sampling/texel_light.h"

#include "protocol/sampling/sobol.h"
#include "tests/support/sample_moments.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace relume::sampling {
namespace {

light::LightCubemap uneven_light(std::uint32_t n) {
    light::LightCubemap light(n);
    const auto planes = light.planes();
    for (std::size_t texel = 0; texel < light.plane_size(); ++texel) {
        for (std::size_t c = 0; c < 3; ++c) {
            planes[c][texel] = texel % 7 == 0 ? 30.0F : static_cast<float>(texel % 5) * 0.1F;
        }
    }
    return light;
}

TEST(TexelLight, SamplesHaveTheDensityThatIsStatedAndFindAllEnergy) {
    const TexelLight light(uneven_light(8));
    const Imath::V3d energy = light::total_energy(light.cubemap());
    test::SampleMoments<double> found(0.0);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const TexelLight::Sample sample =
            light.sample(sobol_point(i, 11).x, sobol_point(i, 12));
        ASSERT_GT(sample.pdf, 0);
        ASSERT_NEAR(sample.direction.length(), 1, 1e-5);
        ASSERT_NEAR(light.pdf(sample.direction), sample.pdf, 1e-3F * sample.pdf);
        found.add(static_cast<double>(light.radiance(sample.direction).x / sample.pdf));
    }
    // Power is sampled exactly; what is left is the place within a texel.
    EXPECT_NEAR(found.mean(), energy.x, 0.01 * energy.x);
    EXPECT_EQ(TexelLight(light::LightCubemap(4)).sample(0.5F, {0.5F, 0.5F}).pdf, 0);
}

}  // namespace
}  // namespace relume::sampling
