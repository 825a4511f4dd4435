#include "precompute/scene/camera.h"

#include "precompute/scene/error.h"
#include "protocol/transport/manifest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

TEST(Camera, CornersOfThePictureAreThoseOfTheFieldOfView) {
    // 90 degrees high and twice as wide, looking along −Z: the corners are (±2, ±1, −1).
    const Camera camera({.eye = {3, -1, 2}, .look_at = {3, -1, 0}, .vertical_fov_degrees = 90},
                        8, 4);
    expect_near(camera.direction_from_pixel(0, 0), Imath::V3f(-2, 1, -1).normalized());
    expect_near(camera.direction_from_pixel(8, 0), Imath::V3f(2, 1, -1).normalized());
    expect_near(camera.direction_from_pixel(0, 4), Imath::V3f(-2, -1, -1).normalized());
    expect_near(camera.direction_from_pixel(8, 4), Imath::V3f(2, -1, -1).normalized());
}

// Who reads a transport takes its rays from the manifest's camera: background and image must
// meet at the outlines of what was baked.
TEST(Camera, ManifestsCameraHasTheSameRays) {
    constexpr std::uint32_t kWidth = 31;
    constexpr std::uint32_t kHeight = 17;
    const transport::TileGrid image{.width = kWidth, .height = kHeight};
    for (const float fov : {5.0F, 40.0F, 120.0F}) {
        const Camera baked({.eye = {1, 1, 4},
                            .look_at = {-2, 0.2F, 0},
                            .up = {0.1F, 1, 0.3F},
                            .vertical_fov_degrees = fov},
                           kWidth, kHeight);
        const transport::CameraRecord read{.eye = baked.eye(),
                                           .right = baked.right(),
                                           .up = baked.up(),
                                           .forward = baked.forward(),
                                           .tan_half_width = baked.tan_half_width(),
                                           .tan_half_height = baked.tan_half_height()};
        for (std::uint32_t y = 0; y <= 2 * kHeight; ++y) {
            for (std::uint32_t x = 0; x <= 2 * kWidth; ++x) {
                const float column = static_cast<float>(x) / 2;
                const float row = static_cast<float>(y) / 2;
                EXPECT_LT((baked.direction_from_pixel(column, row) -
                           read.direction_from_pixel(column, row, image))
                              .length(),
                          1e-6F)
                    << column << ", " << row << ", " << fov << " degrees";
            }
        }
    }
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
