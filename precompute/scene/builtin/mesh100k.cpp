#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/noise.h"
#include "precompute/scene/builtin/scenes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace relume::scene {
namespace {

// 225·225 quads less one triangle per quad at the two poles: 100,800 triangles.
constexpr std::uint32_t kCells = 225;

float displaced_radius(const Imath::V3f& direction) {
    const float broad = fractal_noise(direction * 1.7F + Imath::V3f(11, 3, 5), 4, 0.5F, 1);
    const float ridged = 1.0F - std::abs(fractal_noise(direction * 4.1F, 4, 0.55F, 41));
    return 0.8F + 0.16F * broad + 0.11F * ridged;
}

}  // namespace

Scene build_mesh100k() {
    Scene scene;
    scene.name = "mesh100k";
    scene.materials.push_back({.name = "ground", .base_colour = {0.55F, 0.55F, 0.55F}});
    scene.materials.push_back({.name = "clay", .base_colour = {0.72F, 0.46F, 0.33F}});
    MeshBuilder ground("ground", 0);
    ground.add_quad({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5});
    scene.meshes.push_back(ground.take());
    MeshBuilder ball("ball", 1);
    ball.add_grid(kCells + 1, kCells, Closing::open, Closing::closed,
                  [](std::uint32_t i, std::uint32_t j) {
                      constexpr float kPi = std::numbers::pi_v<float>;
                      const float theta = kPi * static_cast<float>(i) / kCells;
                      const float phi = 2 * kPi * static_cast<float>(j) / kCells;
                      const float ring = i == 0 || i == kCells ? 0.0F : std::sin(theta);
                      const Imath::V3f direction(ring * std::cos(phi), -std::cos(theta),
                                                 -ring * std::sin(phi));
                      return direction * displaced_radius(direction) + Imath::V3f(0, 0.86F, 0);
                  });
    scene.meshes.push_back(ball.take());
    scene.camera = {.name = "front",
                    .eye = {2.3F, 2.1F, 3.5F},
                    .look_at = {0, 0.75F, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 35};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
