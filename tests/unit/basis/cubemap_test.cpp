#include "protocol/basis/cubemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace relume::basis {
namespace {

TEST(Cubemap, TexelsOfEveryResolutionSumToTheSphere) {
    for (std::uint32_t n = kMinFaceResolution; n <= kMaxFaceResolution; n *= 2) {
        double sum = 0;
        for (std::uint32_t row = 0; row < n; ++row) {
            for (std::uint32_t column = 0; column < n; ++column) {
                sum += kFaceCount * solid_angle_sr(n, row, column);
            }
        }
        EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-10) << "n = " << n;
    }
}

TEST(Cubemap, DirectionThroughATexelComesBackToIt) {
    constexpr std::uint32_t n = 16;
    for (std::size_t i = 0; i < texel_count(n); ++i) {
        const Texel texel = texel_from_index(n, i);
        EXPECT_EQ(index_from_texel(n, texel), i);
        for (const float offset : {0.05F, 0.5F, 0.95F}) {
            const Imath::V3f direction = direction_from_texel(n, texel, offset, 1 - offset);
            EXPECT_NEAR(direction.length(), 1, 1e-6);
            EXPECT_EQ(texel_from_direction(n, direction), texel);
        }
    }
}

TEST(Cubemap, FacePointsInvertForAnyDirection) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 10000; ++i) {
        const Imath::V3f direction =
            Imath::V3f(normal(random), normal(random), normal(random)).normalized();
        const FacePoint point = face_point_from_direction(direction);
        EXPECT_LE(std::abs(point.u), 1);
        EXPECT_LE(std::abs(point.v), 1);
        const Imath::V3f back = cube_point_from_face_point(point).normalized();
        EXPECT_LT((back - direction).length(), 1e-6F);
    }
}

TEST(Cubemap, FacesHaveOpenGlsOrientation) {
    // The upper left corner of every face, as the table in cubemap.h gives it.
    const Imath::V3f corners[] = {{1, 1, 1},   {-1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1}, {-1, 1, 1},  {1, 1, -1}};
    for (std::size_t face = 0; face < kFaceCount; ++face) {
        const Imath::V3f corner =
            cube_point_from_face_point({.face = static_cast<Face>(face), .u = -1, .v = -1});
        EXPECT_EQ(corner, corners[face]) << "face " << face;
    }
}

TEST(Cubemap, ResolutionsArePowersOfTwoFrom4To256) {
    for (std::uint32_t n = 0; n <= 1024; ++n) {
        const bool expected =
            n == 4 || n == 8 || n == 16 || n == 32 || n == 64 || n == 128 || n == 256;
        EXPECT_EQ(is_face_resolution(n), expected) << n;
    }
}

}  // namespace
}  // namespace relume::basis
