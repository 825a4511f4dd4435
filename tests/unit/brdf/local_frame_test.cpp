#include "protocol/brdf/local_frame.h"

#include "tests/unit/brdf/random_directions.h"

#include <gtest/gtest.h>

namespace relume::brdf {
namespace {

using Imath::V3f;

const V3f kReference{0.48F, 0.60F, 0.64F};

void expect_orthonormal(const Frame& frame) {
    EXPECT_NEAR(frame.tangent.length(), 1, 1e-5F);
    EXPECT_NEAR(frame.bitangent.length(), 1, 1e-5F);
    EXPECT_NEAR(frame.tangent.dot(frame.normal), 0, 2e-3F);
    EXPECT_NEAR(frame.bitangent.dot(frame.normal), 0, 1e-5F);
    EXPECT_NEAR(frame.tangent.cross(frame.bitangent).dot(frame.normal), 1, 1e-5F);
}

TEST(LocalFrame, MatchesTheWorkedExample) {
    const Frame frame = local_frame({0, 1, 0});
    EXPECT_NEAR(frame.tangent.x, 0.6F, 1e-6F);
    EXPECT_NEAR(frame.tangent.y, 0, 1e-6F);
    EXPECT_NEAR(frame.tangent.z, 0.8F, 1e-6F);
    EXPECT_NEAR(frame.bitangent.x, 0.8F, 1e-6F);
    EXPECT_NEAR(frame.bitangent.y, 0, 1e-6F);
    EXPECT_NEAR(frame.bitangent.z, -0.6F, 1e-6F);
    EXPECT_EQ(frame.normal, V3f(0, 1, 0));
}

TEST(LocalFrame, IsOrthonormalRightHandedAndHoldsTheReferenceInItsPlane) {
    RandomDirections random(1);
    for (int i = 0; i < 1000; ++i) {
        const Frame frame = local_frame(random.on_sphere());
        expect_orthonormal(frame);
        EXPECT_NEAR(frame.bitangent.dot(kReference), 0, 1e-5F);
        EXPECT_GE(frame.tangent.dot(kReference), 0);
    }
}

TEST(LocalFrame, IsOrthonormalWhereTheReferenceIsTheNormal) {
    for (const float sign : {1.0F, -1.0F}) {
        for (const float off : {0.0F, 1e-6F, 5e-5F, 2e-4F, 1e-3F}) {
            expect_orthonormal(
                local_frame((kReference * sign + V3f(off, -off, 0)).normalized()));
        }
    }
}

TEST(LocalFrame, TurnsThereAndBack) {
    RandomDirections random(2);
    for (int i = 0; i < 100; ++i) {
        const Frame frame = local_frame(random.on_sphere());
        const V3f direction = random.on_sphere();
        const V3f back = frame.world_from_local(frame.local_from_world(direction));
        EXPECT_NEAR((back - direction).length(), 0, 1e-5F);
        EXPECT_NEAR(frame.local_from_world(frame.normal).z, 1, 1e-5F);
    }
}

TEST(LocalFrame, ManyHaveTheBitsOfOne) {
    constexpr std::size_t kCount = 1003;
    RandomDirections random(3);
    DirectionList normals(0);
    DirectionList directions(0);
    for (std::size_t i = 0; i < kCount; ++i) {
        normals.add(i == 7 ? kReference : random.on_sphere());
        directions.add(random.on_sphere());
    }
    DirectionList local(kCount);
    local_from_world(normals.planes(), directions.planes(), {local.x, local.y, local.z});
    for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_EQ(local[i], local_frame(normals[i]).local_from_world(directions[i])) << i;
    }
}

}  // namespace
}  // namespace relume::brdf
