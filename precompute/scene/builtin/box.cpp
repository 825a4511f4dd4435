#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"

namespace relume::scene {
namespace {

enum Paint : std::uint32_t { white, red, green };

constexpr float kHalf = 1.0F;  // half the width
constexpr float kHeight = 1.6F;

Mesh wall(const char* name,
          Paint paint,
          const Imath::V3f& p0,
          const Imath::V3f& p1,
          const Imath::V3f& p2,
          const Imath::V3f& p3) {
    MeshBuilder builder(name, paint);
    builder.add_quad(p0, p1, p2, p3);
    return builder.take();
}

}  // namespace

Scene build_box() {
    Scene scene;
    scene.name = "box";
    scene.materials.push_back({.name = "white", .base_colour = {0.73F, 0.71F, 0.68F}});
    scene.materials.push_back({.name = "red", .base_colour = {0.63F, 0.065F, 0.05F}});
    scene.materials.push_back({.name = "green", .base_colour = {0.14F, 0.45F, 0.09F}});
    constexpr float kH = kHalf;
    scene.meshes.push_back(
        wall("floor", white, {-kH, 0, kH}, {kH, 0, kH}, {kH, 0, -kH}, {-kH, 0, -kH}));
    scene.meshes.push_back(wall("back", white, {-kH, 0, -kH}, {kH, 0, -kH}, {kH, kHeight, -kH},
                                {-kH, kHeight, -kH}));
    scene.meshes.push_back(wall("left", red, {-kH, 0, kH}, {-kH, 0, -kH}, {-kH, kHeight, -kH},
                                {-kH, kHeight, kH}));
    scene.meshes.push_back(
        wall("right", green, {kH, 0, -kH}, {kH, 0, kH}, {kH, kHeight, kH}, {kH, kHeight, -kH}));
    MeshBuilder blocks("blocks", white);
    blocks.place(placed({-0.36F, 0, -0.32F}, 17));
    blocks.add_box({0, 0.6F, 0}, {0.58F, 1.2F, 0.58F});
    blocks.place(placed({0.38F, 0, 0.3F}, -18));
    blocks.add_box({0, 0.29F, 0}, {0.58F, 0.58F, 0.58F});
    scene.meshes.push_back(blocks.take());
    scene.camera = {.name = "front",
                    .eye = {0, 1.15F, 4.3F},
                    .look_at = {0, 0.72F, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 32};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
