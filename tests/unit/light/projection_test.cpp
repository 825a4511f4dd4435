#include "protocol/light/projection.h"

#include <gtest/gtest.h>

#include <array>

namespace relume::light {
namespace {

constexpr std::array kAll{Projection::lat_long, Projection::vertical_cross,
                          Projection::horizontal_cross, Projection::angular_map,
                          Projection::cubemap_strip};

TEST(Projection, NamesAreReadBack) {
    for (const Projection projection : kAll) {
        EXPECT_EQ(projection_from_string(to_string(projection)), projection);
    }
    EXPECT_EQ(to_string(Projection::lat_long), "lat_long");
    EXPECT_FALSE(projection_from_string("mirror_ball"));
}

TEST(Projection, IsDetectedByShape) {
    EXPECT_EQ(detect_projection(1024, 512), Projection::lat_long);
    EXPECT_EQ(detect_projection(96, 128), Projection::vertical_cross);
    EXPECT_EQ(detect_projection(128, 96), Projection::horizontal_cross);
    EXPECT_EQ(detect_projection(500, 500), Projection::angular_map);
    EXPECT_EQ(detect_projection(384, 64), Projection::cubemap_strip);
    EXPECT_EQ(detect_projection(64, 384), Projection::cubemap_strip);
    for (const auto& [width, height] :
         {std::pair{1024U, 513U}, {300U, 200U}, {0U, 0U}, {97U, 128U}}) {
        EXPECT_FALSE(detect_projection(width, height)) << width << "x" << height;
    }
}

TEST(Projection, OnlyLatLongMayBeStretched) {
    EXPECT_TRUE(accepts_shape(Projection::lat_long, 1000, 501));
    EXPECT_FALSE(accepts_shape(Projection::lat_long, 0, 501));
    EXPECT_FALSE(accepts_shape(Projection::angular_map, 1000, 501));
    EXPECT_FALSE(accepts_shape(Projection::vertical_cross, 128, 96));
    EXPECT_FALSE(accepts_shape(Projection::cubemap_strip, 100, 100));
}

}  // namespace
}  // namespace relume::light
