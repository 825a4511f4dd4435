#include "protocol/light/procedural_environment.h"

#include "protocol/light/environment_error.h"
#include "protocol/light/preview.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

TEST(ProceduralEnvironment, EveryNameGivesALitLatLongMap) {
    for (const std::string_view name : procedural_environment_names()) {
        const EnvironmentMap map = procedural_environment(name);
        EXPECT_EQ(map.projection(), Projection::lat_long) << name;
        const Imath::V3d energy = map.total_energy();
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(energy[c], 0.5) << name;
            EXPECT_LT(energy[c], 100) << name;
        }
    }
    EXPECT_THROW((void)procedural_environment("sky"), EnvironmentError);
}

TEST(ProceduralSky, TheSunStandsWhereItIsPut) {
    const SkyParameters parameters{
        .sun_elevation_radians = 0.6F, .sun_azimuth_radians = 2.0F, .height = 256};
    const EnvironmentMap map = procedural_sky(parameters);
    const Imath::V3f sun(std::cos(0.6F) * std::sin(2.0F), std::sin(0.6F),
                         -std::cos(0.6F) * std::cos(2.0F));
    std::mt19937 generator(1);
    const float brightest = map.radiance(sun).x;
    for (int i = 0; i < 2000; ++i) {
        const Imath::V3f d = testing::random_direction(generator);
        if ((d - sun).length() > 0.05F) {
            EXPECT_LT(map.radiance(d).x, brightest / 20);
        }
    }
}

TEST(ProceduralSky, TheSunsEnergyDoesNotDependOnTheResolution) {
    SkyParameters parameters{.height = 128};
    const double coarse = procedural_sky(parameters).total_energy().y;
    parameters.height = 1024;
    EXPECT_NEAR(procedural_sky(parameters).total_energy().y / coarse, 1, 0.03);
}

TEST(ProceduralSky, LowSunsAreRedAndHazyOnesWeak) {
    const auto sun_colour = [](float elevation, float turbidity) {
        SkyParameters parameters{
            .sun_elevation_radians = elevation, .turbidity = turbidity, .height = 512};
        const Imath::V3f sun(std::cos(elevation) * std::sin(0.5F), std::sin(elevation),
                             -std::cos(elevation) * std::cos(0.5F));
        return procedural_sky(parameters).radiance(sun);
    };
    const Imath::V3f noon = sun_colour(1.3F, 3);
    const Imath::V3f dusk = sun_colour(0.05F, 3);
    EXPECT_GT(dusk.x / dusk.z, 5 * noon.x / noon.z);
    EXPECT_LT(sun_colour(0.6F, 8).y, 0.7F * sun_colour(0.6F, 2).y);
}

TEST(ProceduralSky, OvercastIsThreeTimesBrighterAtTheZenith) {
    const EnvironmentMap map = procedural_sky({.overcast = true, .height = 256});
    EXPECT_NEAR(map.radiance({0, 1, 0}).x / map.radiance({1, 0.01F, 0}).x, 3, 0.06);
}

TEST(ProceduralSky, TheGroundReflectsItsAlbedo) {
    // Under the overcast sky E = π·(7/9)·zenith, so radiance of a white ground is 7/9 of the
    // zenith's.
    const EnvironmentMap map =
        procedural_sky({.overcast = true, .ground_albedo = Imath::V3f(1), .height = 256});
    EXPECT_NEAR(map.radiance({0, -1, 0}).x / map.radiance({0, 1, 0}).x, 7.0 / 9, 0.005);
}

TEST(ProceduralSky, RefusesWhatIsOutOfRange) {
    EXPECT_THROW((void)procedural_sky({.sun_elevation_radians = -0.1F}), EnvironmentError);
    EXPECT_THROW((void)procedural_sky({.turbidity = 1}), EnvironmentError);
    EXPECT_THROW((void)procedural_sky({.height = 100000}), EnvironmentError);
    EXPECT_THROW((void)procedural_sky({.sun_azimuth_radians = std::nanf("")}),
                 EnvironmentError);
}

TEST(Preview, IsExposedAndUpright) {
    const auto map = testing::lat_long_map(128, [](const Imath::V3f& d) {
        return Imath::V3f(d.y > 0 ? 4e4F : 1e4F, 1e4F, d.x > 0 ? 4e4F : 1e4F);
    });
    const PreviewImage preview = make_preview(*map);
    ASSERT_EQ(preview.width, 256U);
    ASSERT_EQ(preview.height, 128U);
    ASSERT_EQ(preview.rgb.size(), 256U * 128 * 3);
    const auto at = [&](std::size_t x, std::size_t y, std::size_t c) {
        return preview.rgb[(y * 256 + x) * 3 + c];
    };
    EXPECT_GT(at(20, 10, 0), at(20, 110, 0) + 30);  // up is at the top
    EXPECT_GT(at(200, 60, 2), at(50, 60, 2) + 30);  // +X is on the right
    EXPECT_GT(at(20, 110, 1), 60);                  // neither black
    EXPECT_LT(at(20, 10, 0), 255);                  // nor burnt out
}

TEST(Preview, TakesAnyProjectionAndABlackMap) {
    const MapImage cross =
        testing::draw(Projection::vertical_cross, 96, 128, testing::smooth_radiance);
    const PreviewImage of_cross =
        make_preview(EnvironmentMap(cross, Projection::vertical_cross), 32, 16);
    const PreviewImage of_lat_long =
        make_preview(*testing::lat_long_map(64, testing::smooth_radiance), 32, 16);
    for (std::size_t i = 0; i < of_cross.rgb.size(); ++i) {
        EXPECT_NEAR(of_cross.rgb[i], of_lat_long.rgb[i], 3);
    }
    const PreviewImage black = make_preview(
        *testing::lat_long_map(8, [](const Imath::V3f&) { return Imath::V3f(0); }));
    EXPECT_EQ(black.rgb, std::vector<std::uint8_t>(256U * 128 * 3, 0));
}

}  // namespace
}  // namespace relume::light
