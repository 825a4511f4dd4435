#include "precompute/scene/camera.h"

#include "precompute/scene/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace relume::scene {
namespace {

void expect_near(const Imath::V3f& a, const Imath::V3f& b) {
    EXPECT_LT((a - b).length(), 1e-5F) << a << " and " << b;
}

TEST(Camera, BasisIsOrthonormalAndRightHanded) {
    const Camera camera({.eye = {1, 2, 3}, .look_at = {-2, 0.5F, 1}}, 640, 480);
    expect_near(camera.right().cross(camera.up()), -camera.forward());
    EXPECT_NEAR(camera.right().length(), 1.0F, 1e-6F);
    EXPECT_NEAR(camera.up().length(), 1.0F, 1e-6F);
    EXPECT_NEAR(camera.right().dot(camera.up()), 0.0F, 1e-6F);
    EXPECT_GT(camera.up().y, 0.0F);
}

TEST(Camera, MiddleOfThePictureLooksForwardAndEdgesSpanTheFieldOfView) {
    const Camera camera({.eye = {0, 0, 5}, .look_at = {0, 0, 0}, .vertical_fov_degrees = 60},
                        300, 200);
    expect_near(camera.direction_from_pixel(150, 100), {0, 0, -1});
    const Imath::V3f top = camera.direction_from_pixel(150, 0);
    EXPECT_NEAR(std::atan2(top.y, -top.z), 30.0F * 3.14159265F / 180.0F, 1e-5F);
    const Imath::V3f right = camera.direction_from_pixel(300, 100);
    EXPECT_GT(right.x, 0.0F);
    EXPECT_NEAR(right.x / -right.z, 1.5F * std::tan(0.5235988F), 1e-5F);
}

TEST(Camera, RaysAreThoseOfTheManifest) {
    const Camera camera({.eye = {1, 1, 4}, .look_at = {0, 0.2F, 0}}, 31, 17);
    const float x = 20;
    const float y = 3;
    const Imath::V3f expected =
        camera.forward() +
        camera.right() * ((2.0F * (x + 0.5F) / 31.0F - 1.0F) * camera.tan_half_width()) +
        camera.up() * ((1.0F - 2.0F * (y + 0.5F) / 17.0F) * camera.tan_half_height());
    expect_near(camera.direction_from_pixel(x + 0.5F, y + 0.5F), expected.normalized());
}

TEST(Camera, UpAlongTheViewIsReplaced) {
    const Camera camera({.eye = {0, 5, 0}, .look_at = {0, 0, 0}, .up = {0, 1, 0}}, 10, 10);
    EXPECT_NEAR(camera.right().length(), 1.0F, 1e-6F);
    EXPECT_NEAR(camera.up().dot(camera.forward()), 0.0F, 1e-6F);
}

TEST(Camera, RefusesWhatIsNoCamera) {
    const float inf = std::numeric_limits<float>::infinity();
    const auto fault_of = [](const CameraPlacement& placement, std::uint32_t w,
                             std::uint32_t h) {
        try {
            const Camera camera(placement, w, h);
        } catch (const SceneError& error) {
            return error.fault();
        }
        return SceneFault::unknown_name;
    };
    const CameraPlacement good{.eye = {0, 0, 1}, .look_at = {0, 0, 0}};
    CameraPlacement bad = good;
    bad.look_at = bad.eye;
    EXPECT_EQ(fault_of(bad, 8, 8), SceneFault::bad_camera);
    bad = good;
    bad.eye.x = inf;
    EXPECT_EQ(fault_of(bad, 8, 8), SceneFault::bad_camera);
    for (const float fov : {0.0F, -1.0F, 180.0F, std::nanf("")}) {
        bad = good;
        bad.vertical_fov_degrees = fov;
        EXPECT_EQ(fault_of(bad, 8, 8), SceneFault::bad_camera) << fov;
    }
    EXPECT_EQ(fault_of(good, 0, 8), SceneFault::bad_camera);
    EXPECT_EQ(fault_of(good, 8, 0), SceneFault::bad_camera);
}

}  // namespace
}  // namespace relume::scene
