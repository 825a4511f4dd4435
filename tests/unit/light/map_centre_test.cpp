// Maps whose centre looks elsewhere: where Blender and three.js see a place of a picture.
#include "protocol/light/map_centre.h"

#include "protocol/light/rotation_resample.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

using namespace testing;

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

// Blender's equirectangular projection, Z up: u = ½ − atan2(y, x)/2π, v = ½ + latitude/π from
// the bottom. A world direction of Blender's, as its glTF exporter turns it to Y up.
Imath::V3f direction_in_blender(float x, float y) {
    const float longitude = kTurn * (0.5F - x);
    const float latitude = std::numbers::pi_v<float> * (0.5F - y);
    const Imath::V3f z_up(std::cos(latitude) * std::cos(longitude),
                          std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    return {z_up.x, z_up.z, -z_up.y};
}

// three.js's equirectUv, Y up: u = ½ + atan(z, x)/2π.
Imath::V3f direction_in_three(float x, float y) {
    const float longitude = kTurn * (x - 0.5F);
    const float latitude = std::numbers::pi_v<float> * (0.5F - y);
    return {std::cos(latitude) * std::cos(longitude), std::sin(latitude),
            std::cos(latitude) * std::sin(longitude)};
}

// A lat-long map, black but for one texel.
EnvironmentMap one_texel(std::uint32_t column, std::uint32_t row, MapCentre centre) {
    MapImage image{64, 32, std::vector<float>(std::size_t{3} * 64 * 32)};
    image.rgb[(row * 64 + column) * 3] = 1;
    return {std::move(image), Projection::lat_long, centre};
}

TEST(MapCentre, NamesGoBothWays) {
    for (const char* name : {"-z", "+z", "+x", "-x", "+y", "-y"}) {
        const auto centre = map_centre_from_string(name);
        ASSERT_TRUE(centre) << name;
        EXPECT_EQ(to_string(*centre), name);
    }
    EXPECT_FALSE(map_centre_from_string("x"));
    EXPECT_FALSE(map_centre_from_string(""));
}

TEST(MapCentre, TheMiddleOfTheMapLooksThere) {
    struct {
        const char* name;
        Imath::V3f middle;
        Imath::V3f right;
        Imath::V3f up;
    } const cases[] = {
        {"-z", {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}, {"+z", {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
        {"+x", {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},  {"-x", {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {"+y", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},  {"-y", {0, -1, 0}, {1, 0, 0}, {0, 0, -1}}};
    for (const auto& c : cases) {
        const Imath::M33f turn = turn_of_centre(map_centre_from_string(c.name).value());
        EXPECT_EQ(product(turn, Imath::V3f(0, 0, -1)), c.middle) << c.name;
        EXPECT_EQ(product(turn, Imath::V3f(1, 0, 0)), c.right) << c.name;
        EXPECT_EQ(product(turn, Imath::V3f(0, 1, 0)), c.up) << c.name;
    }
}

TEST(MapCentre, PlusXIsWhereBlenderAndThreeSeeEveryPlaceOfTheMap) {
    for (const std::uint32_t column : {0U, 10U, 31U, 50U}) {
        for (const std::uint32_t row : {5U, 16U, 28U}) {
            const float x = (static_cast<float>(column) + 0.5F) / 64;
            const float y = (static_cast<float>(row) + 0.5F) / 32;
            const EnvironmentMap map = one_texel(column, row, MapCentre::positive_x);
            EXPECT_NEAR(map.radiance(direction_in_blender(x, y)).x, 1, 1e-4F);
            EXPECT_NEAR(map.radiance(direction_in_three(x, y)).x, 1, 1e-4F);
        }
    }
}

TEST(MapCentre, LightAndSightAgreeInEveryCentreAndProjection) {
    // A map drawn for a centre at −Z that shows f, taken with centre c, shows f∘C⁻¹.
    for (const Projection projection :
         {Projection::lat_long, Projection::angular_map, Projection::vertical_cross}) {
        const std::uint32_t width = projection == Projection::lat_long ? 128 : 96;
        const std::uint32_t height = projection == Projection::lat_long      ? 64
                                     : projection == Projection::angular_map ? 96
                                                                             : 128;
        const MapImage image = draw(projection, width, height, smooth_radiance);
        for (const char* name : {"-z", "+z", "+x", "-x", "+y", "-y"}) {
            const MapCentre centre = map_centre_from_string(name).value();
            const Imath::M33f back = turn_of_centre(centre).transposed();
            const auto map = std::make_shared<EnvironmentMap>(image, projection, centre);
            const PrefilteredEnvironment environment(map, 16);
            LightCubemap cubemap(16);
            resample(environment, Imath::Quatf(), Imath::V3f(1), Write::overwrite, cubemap);
            for (std::size_t i = 0; i < cubemap.plane_size(); i += 7) {
                const Imath::V3f d =
                    basis::direction_from_texel(16, basis::texel_from_index(16, i));
                const Imath::V3f expected = smooth_radiance(product(back, d));
                EXPECT_NEAR(map->radiance(d).y, expected.y, 0.03F) << name;
                EXPECT_NEAR(cubemap.planes()[1][i], expected.y, 0.03F) << name;
            }
        }
    }
}

}  // namespace
}  // namespace relume::light
