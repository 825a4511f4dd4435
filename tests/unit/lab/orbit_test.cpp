// A camera that goes around what it looks at.
#include "tests/lab/geometry/orbit.h"

#include <gtest/gtest.h>

namespace relume::lab {
namespace {

TEST(Orbit, KeepsDistanceAndHeightAndComesBack) {
    const view::Look from{.eye = {3, 2, 1}, .look_at = {1, 1, 1}, .up = {0.1, 0.9, 0.2}};
    const view::Look quarter = orbited(from, 90);
    EXPECT_NEAR((quarter.eye - from.look_at).length(), (from.eye - from.look_at).length(),
                1e-12);
    EXPECT_EQ(quarter.eye.y, from.eye.y);
    EXPECT_NEAR(quarter.eye.x, 1, 1e-12);
    EXPECT_NEAR(quarter.eye.z, -1, 1e-12);
    const view::Look back = orbited(orbited(from, 70), -70);
    EXPECT_NEAR((back.eye - from.eye).length(), 0, 1e-12);
    EXPECT_NEAR((back.up - from.up).length(), 0, 1e-12);
    // What looks straight ahead still does.
    EXPECT_NEAR((quarter.look_at - from.look_at).length(), 0, 0);
}

}  // namespace
}  // namespace relume::lab
