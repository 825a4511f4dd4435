#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relume::scene {
namespace {

enum Finish : std::uint32_t { stone, gold, iron };

// The (2, 3) torus knot around +Y, as a tube that closes on itself.
Mesh knot() {
    constexpr std::uint32_t kSegments = 360;
    constexpr std::uint32_t kSides = 40;
    constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;
    const auto centre = [](float t) {
        const float ring = 0.52F + 0.24F * std::cos(3.0F * t);
        return Imath::V3f(ring * std::cos(2.0F * t), 0.5F + 0.34F * std::sin(3.0F * t),
                          ring * std::sin(2.0F * t));
    };
    MeshBuilder builder("knot", gold);
    builder.add_grid(kSegments, kSides, Closing::closed, Closing::closed,
                     [&](std::uint32_t i, std::uint32_t j) {
                         const float t = kTwoPi * static_cast<float>(i) / kSegments;
                         const float phi = kTwoPi * static_cast<float>(j) / kSides;
                         const Imath::V3f c = centre(t);
                         const Imath::V3f along =
                             (centre(t + 1e-2F) - centre(t - 1e-2F)).normalized();
                         // A frame that closes by itself: away from the knot's centre.
                         const Imath::V3f out = c - Imath::V3f(0, 0.5F, 0);
                         const Imath::V3f across = (out - along * out.dot(along)).normalized();
                         const Imath::V3f side = along.cross(across);
                         return c + (across * std::cos(phi) + side * std::sin(phi)) * 0.155F;
                     });
    return builder.take();
}

Mesh grille() {
    constexpr float kHeight = 1.5F;
    constexpr float kReach = 1.3F;
    constexpr float kRadius = 0.009F;
    constexpr int kBars = 14;
    MeshBuilder builder("grille", iron);
    for (int i = -kBars; i <= kBars; ++i) {
        const float x = kReach * static_cast<float>(i) / kBars;
        builder.add_tube({{{x, kHeight, -kReach}, kRadius}, {{x, kHeight, kReach}, kRadius}},
                         12, Closing::closed);
    }
    for (int i = -3; i <= 3; ++i) {
        const float z = kReach * static_cast<float>(i) / 3.0F;
        const float y = kHeight - 2.2F * kRadius;
        builder.add_tube({{{-kReach, y, z}, kRadius}, {{kReach, y, z}, kRadius}}, 12,
                         Closing::closed);
    }
    for (const float x : {-kReach, kReach}) {
        for (const float z : {-kReach, kReach})
            builder.add_tube({{{x, 0, z}, 0.022F}, {{x, kHeight, z}, 0.022F}}, 16,
                             Closing::closed);
    }
    return builder.take();
}

}  // namespace

Scene build_thin() {
    Scene scene;
    scene.name = "thin";
    scene.materials.push_back({.name = "stone", .base_colour = {0.62F, 0.60F, 0.57F}});
    scene.materials.push_back({.name = "gold",
                               .model = BsdfModel::ggx,
                               .base_colour = {0.95F, 0.66F, 0.30F},
                               .metallic = 1,
                               .roughness = 0.38F});
    scene.materials.push_back({.name = "iron",
                               .model = BsdfModel::ggx,
                               .base_colour = {0.12F, 0.12F, 0.13F},
                               .metallic = 0,
                               .roughness = 0.5F});
    MeshBuilder ground("ground", stone);
    ground.add_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4});
    scene.meshes.push_back(ground.take());
    scene.meshes.push_back(knot());
    scene.meshes.push_back(grille());
    scene.camera = {.name = "front",
                    .eye = {1.9F, 2.7F, 3.7F},
                    .look_at = {0, 0.62F, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 40};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
