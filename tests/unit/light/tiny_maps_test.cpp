// Maps of few texels: whatever shape is taken must give light that is finite, and a constant
// one the same light everywhere.
#include "protocol/light/background.h"
#include "protocol/light/rotation_resample.h"
#include "tests/unit/light/synthetic_maps.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>

namespace relume::light {
namespace {

using namespace testing;

constexpr std::uint32_t kLargestSide = 8;
constexpr std::array<Projection, 5> kProjections{
    Projection::lat_long, Projection::vertical_cross, Projection::horizontal_cross,
    Projection::angular_map, Projection::cubemap_strip};

template <typename Check>
void for_each_tiny_shape(Check check) {
    for (const Projection projection : kProjections) {
        for (std::uint32_t width = 1; width <= kLargestSide; ++width) {
            for (std::uint32_t height = 1; height <= kLargestSide; ++height) {
                if (accepts_shape(projection, width, height)) {
                    SCOPED_TRACE(fmt::format("{} {}x{}", to_string(projection), width, height));
                    check(projection, width, height);
                }
            }
        }
    }
}

std::shared_ptr<const EnvironmentMap> constant_map(Projection projection,
                                                   std::uint32_t width,
                                                   std::uint32_t height) {
    MapImage image{width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        image.rgb.insert(image.rgb.end(), {3.0F, 1.0F, 0.1F});
    }
    return std::make_shared<EnvironmentMap>(std::move(image), projection);
}

LightCubemap lit_by(const std::shared_ptr<const EnvironmentMap>& map,
                    std::uint32_t n,
                    const Imath::Quatf& rotation) {
    const PrefilteredEnvironment environment(map, n);
    LightCubemap cubemap(n);
    resample(environment, rotation, Imath::V3f(1), Write::overwrite, cubemap);
    return cubemap;
}

TEST(TinyMaps, AConstantMapOfAnyShapeIsConstantLight) {
    std::mt19937 generator(5);
    for_each_tiny_shape([&](Projection projection, std::uint32_t width, std::uint32_t height) {
        const auto map = constant_map(projection, width, height);
        for (const std::uint32_t n : {4U, 16U}) {
            const LightCubemap cubemap = lit_by(map, n, random_rotation(generator));
            const auto planes = cubemap.planes();
            for (std::size_t texel = 0; texel < cubemap.plane_size(); ++texel) {
                ASSERT_NEAR(planes[0][texel], 3.0F, 9e-6F);
                ASSERT_NEAR(planes[1][texel], 1.0F, 3e-6F);
                ASSERT_NEAR(planes[2][texel], 0.1F, 3e-7F);
            }
        }
        for (int i = 0; i < 50; ++i) {
            for (const float footprint_sr : {0.0F, 1e-5F, 0.01F, 1.0F}) {
                const Imath::V3f seen =
                    map->radiance(random_direction(generator), footprint_sr);
                ASSERT_NEAR(seen.x, 3.0F, 9e-6F);
                ASSERT_NEAR(seen.z, 0.1F, 3e-7F);
            }
        }
    });
}

TEST(TinyMaps, LightOfAnyValuesIsFiniteAndKeepsItsEnergy) {
    std::mt19937 generator(6);
    std::uniform_real_distribution<float> exponent(-10, 10);
    for_each_tiny_shape([&](Projection projection, std::uint32_t width, std::uint32_t height) {
        MapImage image{width, height, {}};
        for (std::uint32_t i = 0; i < 3 * width * height; ++i) {
            image.rgb.push_back(std::pow(10.0F, exponent(generator)));
        }
        const auto map = std::make_shared<EnvironmentMap>(std::move(image), projection);
        const LightCubemap cubemap = lit_by(map, 16, random_rotation(generator));
        for (const float value : cubemap.radiance) {
            ASSERT_TRUE(value >= 0 && value <= 2 * kMaxTexelRadiance) << value;
        }
        // Texels of a quarter of the sphere and more: total_energy takes each at its middle.
        if (projection != Projection::angular_map || width > 2) {
            EXPECT_NEAR(total_energy(cubemap).x / map->total_energy().x, 1, 0.35);
        }
    });
}

}  // namespace
}  // namespace relume::light
