#include "protocol/light/environment_map.h"

#include "protocol/light/environment_error.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace relume::light {
namespace {

using namespace testing;

struct Shape {
    Projection projection;
    std::uint32_t width;
    std::uint32_t height;
};
const Shape kShapes[] = {
    {Projection::lat_long, 256, 128},         {Projection::vertical_cross, 192, 256},
    {Projection::horizontal_cross, 256, 192}, {Projection::angular_map, 256, 256},
    {Projection::cubemap_strip, 384, 64},     {Projection::cubemap_strip, 64, 384},
    {Projection::lat_long, 300, 101}};

float distance(const Imath::V3f& a, const Imath::V3f& b) {
    return (a - b).length();
}

TEST(EnvironmentMap, ShowsInEveryDirectionWhatWasDrawnThere) {
    std::mt19937 generator(1);
    for (const Shape& shape : kShapes) {
        const EnvironmentMap map(
            draw(shape.projection, shape.width, shape.height, smooth_radiance),
            shape.projection);
        for (int i = 0; i < 2000; ++i) {
            const Imath::V3f direction = random_direction(generator);
            // A bilinear lookup errs by the curvature over a texel; the rim of an angular map
            // by what lies across its wide texels.
            const float bound = shape.projection == Projection::angular_map ? 0.05F : 0.01F;
            EXPECT_LT(distance(map.radiance(direction * 3.0F), smooth_radiance(direction)),
                      bound)
                << to_string(shape.projection) << " " << direction;
        }
    }
}

TEST(EnvironmentMap, IsContinuousAcrossSeamsPolesEdgesAndCorners) {
    const Imath::V3f places[] = {{0, 0, 1}, {0, 1, 0},   {0, -1, 0},     {1, 1, 0.3F},
                                 {1, 1, 1}, {-1, 1, -1}, {0.2F, 0.1F, 1}};
    std::mt19937 generator(2);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    for (const Shape& shape : kShapes) {
        if (shape.projection == Projection::angular_map) {
            continue;  // its rim is one direction seen a thousand times; the next test covers
                       // it
        }
        MapImage noise = draw(shape.projection, shape.width, shape.height, smooth_radiance, 1);
        for (float& value : noise.rgb) {
            value = uniform(generator);
        }
        const EnvironmentMap map(std::move(noise), shape.projection);
        for (const Imath::V3f& place : places) {
            for (int i = 0; i < 50; ++i) {
                const Imath::V3f here =
                    place.normalized() + 1e-3F * random_direction(generator);
                const Imath::V3f there = here + 1e-5F * random_direction(generator);
                // Along a parallel right at a pole, directions turn fast.
                const bool at_pole =
                    shape.projection == Projection::lat_long && std::abs(here.y) > 0.9F;
                EXPECT_LT(distance(map.radiance(here), map.radiance(there)),
                          at_pole ? 1.0F : 0.01F)
                    << to_string(shape.projection) << " " << place;
            }
        }
    }
}

TEST(EnvironmentMap, BlankPartsOfAMapDoNotBleedIn) {
    for (const Shape& shape : kShapes) {
        const EnvironmentMap map(draw(
                                     shape.projection, shape.width, shape.height,
                                     [](const Imath::V3f&) { return Imath::V3f(2); }, 2, 1e4F),
                                 shape.projection);
        for (const Imath::V3f& direction :
             {Imath::V3f(0, 0, 1), Imath::V3f(1e-3F, 0, 1), Imath::V3f(-0.1F, 0.05F, 1)}) {
            for (const float footprint : {0.0F, 1e-4F, 0.1F, 3.0F}) {
                EXPECT_NEAR(map.radiance(direction, footprint).x, 2.0F, 1e-4F)
                    << to_string(shape.projection) << " " << footprint;
            }
        }
    }
}

TEST(EnvironmentMap, CoarserLevelsKeepTheEnergy) {
    std::mt19937 generator(3);
    for (const Shape& shape : kShapes) {
        const EnvironmentMap map(
            draw(shape.projection, shape.width, shape.height, smooth_radiance),
            shape.projection);
        const Imath::V3d whole = map.total_energy();
        EXPECT_NEAR(whole.x, 4 * std::numbers::pi * 1.5, 0.01 * whole.x)
            << to_string(shape.projection);
        // Over a footprint as large as the sphere every direction shows about the mean of its
        // half.
        ASSERT_GT(map.levels().size(), 3U);
        EXPECT_LE(map.levels().back().height, 4U);
        Imath::V3d sum(0);
        constexpr int kDirections = 4000;
        for (int i = 0; i < kDirections; ++i) {
            sum += Imath::V3d(map.radiance(random_direction(generator), 0.02F));
        }
        EXPECT_NEAR(sum.y / kDirections, whole.y / (4 * std::numbers::pi), 0.03);
    }
}

TEST(EnvironmentMap, AWidePixelSeesTheMeanAndNotOneTexel) {
    // A checkerboard of single texels is grey from afar, near the poles too.
    constexpr std::uint32_t kHeight = 256;
    MapImage image{2 * kHeight, kHeight, {}};
    for (std::uint32_t i = 0; i < 2 * kHeight * kHeight; ++i) {
        const bool bright = ((i % (2 * kHeight)) + i / (2 * kHeight)) % 2 == 0;
        image.rgb.insert(image.rgb.end(), 3, bright ? 2.0F : 0.0F);
    }
    const EnvironmentMap map(std::move(image), Projection::lat_long);
    std::mt19937 generator(4);
    const float texel_side = std::numbers::pi_v<float> / kHeight;
    for (int i = 0; i < 200; ++i) {
        const Imath::V3f direction = random_direction(generator);
        EXPECT_NEAR(map.radiance(direction, 16 * texel_side * texel_side).x, 1.0F, 0.05F)
            << direction;
    }
}

TEST(EnvironmentMap, RefusesWrongShapesAndValues) {
    const auto attempt = [](std::uint32_t width, std::uint32_t height, Projection projection,
                            float value) {
        return EnvironmentMap(
            {width, height, std::vector<float>(std::size_t{width} * height * 3, value)},
            projection);
    };
    EXPECT_NO_THROW(attempt(2, 1, Projection::lat_long, 1));
    try {
        attempt(10, 7, Projection::vertical_cross, 1);
        FAIL();
    } catch (const EnvironmentError& e) {
        EXPECT_EQ(e.found(), "10x7");
        EXPECT_NE(e.expected().find("3:4"), std::string::npos) << e.expected();
        EXPECT_NE(std::string(e.what()).find("10x7"), std::string::npos);
    }
    EXPECT_THROW(attempt(0, 0, Projection::lat_long, 1), EnvironmentError);
    EXPECT_THROW(attempt(kMaxMapSide + 2, 1, Projection::lat_long, 1), EnvironmentError);
    for (const float value : {-1e-6F, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), 2e10F}) {
        EXPECT_THROW(attempt(4, 2, Projection::lat_long, value), EnvironmentError) << value;
    }
    EXPECT_THROW(EnvironmentMap({4, 2, std::vector<float>(23)}, Projection::lat_long),
                 EnvironmentError);
}

}  // namespace
}  // namespace relume::light
