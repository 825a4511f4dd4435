#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relume::scene {

Scene build_bowl() {
    constexpr std::uint32_t kRings = 24;
    Scene scene;
    scene.name = "bowl";
    scene.materials.push_back({.name = "white", .base_colour = {1, 1, 1}});
    MeshBuilder bowl("bowl", 0);
    std::vector<ProfilePoint> outline;
    for (std::uint32_t i = 0; i <= kRings; ++i) {
        const float theta = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / kRings;
        outline.push_back({i == 0 ? 0.0F : std::sin(theta), 1.0F - std::cos(theta)});
    }
    bowl.add_lathe(outline, 64);
    scene.meshes.push_back(bowl.take());
    // Interpolated normals disagree with the facets and would lose light to their horizon: a
    // furnace needs the facets themselves.
    scene.meshes.back().normals.clear();
    scene.camera = {.name = "above",
                    .eye = {0, 2.6F, 0},
                    .look_at = {0, 0, 0},
                    .up = {0, 0, -1},
                    .vertical_fov_degrees = 36};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
