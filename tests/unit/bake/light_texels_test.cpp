#include "precompute/bake/rows/light_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

namespace relume::bake {
namespace {

TEST(LightTexels, PlacesAreATourOfAllTexels) {
    const LightTexels texels(16, 3);
    std::set<std::size_t> seen;
    for (std::size_t place = 0; place < texels.size(); ++place) {
        const std::size_t index = texels.texel_index(place);
        EXPECT_TRUE(seen.insert(index).second);
        EXPECT_EQ(texels.place_from_texel_index(index), place);
    }
    EXPECT_EQ(seen.size(), basis::texel_count(16));
}

TEST(LightTexels, DirectionsFallIntoTheirTexels) {
    const LightTexels texels(16, 3);
    for (std::size_t place = 0; place < texels.size(); ++place) {
        for (const auto& [column, row] : {std::pair{0.02F, 0.9F}, std::pair{0.5F, 0.5F}}) {
            const Imath::V3f point = texels.cube_point(place, column, row);
            EXPECT_EQ(basis::index_from_texel(16, basis::texel_from_direction(16, point)),
                      texels.texel_index(place));
        }
    }
}

TEST(LightTexels, PacketsHoldTheSamePointsAsPlaces) {
    const LightTexels texels(8, 1);
    std::array<float, kPacketSize> columns{};
    std::array<float, kPacketSize> rows{};
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        columns[lane] = 0.05F * static_cast<float>(lane);
        rows[lane] = 1 - columns[lane];
    }
    RayPacket points({0, 0, 0});
    for (std::size_t packet = 0; packet < texels.packet_count(); ++packet) {
        texels.cube_points(packet, columns, rows, points);
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            const Imath::V3f one =
                texels.cube_point(packet * kPacketSize + lane, columns[lane], rows[lane]);
            EXPECT_NEAR(points.x()[lane], one.x, 1e-6F);
            EXPECT_NEAR(points.y()[lane], one.y, 1e-6F);
            EXPECT_NEAR(points.z()[lane], one.z, 1e-6F);
        }
    }
}

TEST(LightTexels, SolidAnglesCoverTheSphereAndBoundTheirIrradiance) {
    const LightTexels texels(32, 0);
    double sum = 0;
    for (std::size_t place = 0; place < texels.size(); ++place) {
        sum += texels.solid_angle_sr()[place];
        EXPECT_LT(texels.irradiance()[place], texels.solid_angle_sr()[place] * 1.00001F);
        EXPECT_GT(texels.irradiance()[place], texels.solid_angle_sr()[place] * 0.999F);
    }
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-5);
}

TEST(LightTexels, CornersStayWithinTheirRadii) {
    const LightTexels texels(4, 0);
    for (std::size_t place = 0; place < texels.size(); ++place) {
        const std::size_t packet = place / kPacketSize;
        const Imath::V3f centroid{texels.direction_x()[place], texels.direction_y()[place],
                                  texels.direction_z()[place]};
        for (const float column : {0.0F, 1.0F}) {
            for (const float row : {0.0F, 1.0F}) {
                const Imath::V3f corner = texels.cube_point(place, column, row).normalized();
                EXPECT_LE(centroid.cross(corner).length(), texels.sine_radius(packet));
                EXPECT_LE(texels.packet_direction(packet).cross(corner).length(),
                          texels.packet_sine_radius(packet));
            }
        }
    }
}

TEST(LightTexels, ScatterPutsEveryPlaceWhereItsTexelIs) {
    const LightTexels texels(8, 0);
    std::vector<float> by_place(texels.size());
    for (std::size_t place = 0; place < by_place.size(); ++place) {
        by_place[place] = static_cast<float>(texels.texel_index(place));
    }
    std::vector<float> by_texel(texels.size());
    texels.scatter(by_place, by_texel);
    for (std::size_t index = 0; index < by_texel.size(); ++index) {
        EXPECT_EQ(by_texel[index], static_cast<float>(index));
    }
}

}  // namespace
}  // namespace relume::bake
