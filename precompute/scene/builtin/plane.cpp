#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"

namespace relume::scene {

Scene build_plane() {
    Scene scene;
    scene.name = "plane";
    scene.materials.push_back({.name = "white", .base_colour = {1, 1, 1}});
    MeshBuilder plane("plane", 0);
    plane.add_quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    scene.meshes.push_back(plane.take());
    // Straight above and close: the plane fills a picture of any usual shape.
    scene.camera = {.name = "above",
                    .eye = {0, 1, 0},
                    .look_at = {0, 0, 0},
                    .up = {0, 0, -1},
                    .vertical_fov_degrees = 45};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
