// A scene as its file gives it, before it becomes what the bake works on.
#pragma once

#include "precompute/scene/scene.h"
#include "precompute/scene/up_axis.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene {

// A perspective camera of a file, in the file's world coordinates. Two nodes that share one
// camera are two of these; names may be empty and need not be unique.
struct NamedCamera {
    std::string name{};
    std::string node_path{};  // names from the root of the scene to the camera's node, by '/'
    std::uint32_t index = 0;  // place in ImportedScene::cameras
    Imath::V3d eye{0, 0, 0};
    Imath::V3d forward{0, 0, -1};  // unit: a direction, so that distance cannot blur it
    Imath::V3d up{0, 1, 0};        // unit, not along `forward` in a sound file
    double vertical_fov_degrees = 40;
};

// World coordinates are doubles up to `scene_in_float`, so that a scene far from its origin
// keeps its shape.
struct ImportedScene {
    Scene scene;  // all but the camera and the positions of the meshes, which are empty
    std::vector<std::vector<Imath::V3d>> positions{};  // world; one list for each mesh
    std::vector<NamedCamera> cameras{};                // in the file's order; may be empty
    // Distance in the world between neighbouring numbers of the file where its positions are
    // largest; 0 where it is finer than a double's.
    double position_step = 0;
};

// Throws SceneError (non_finite_vertex).
void check_positions(const ImportedScene& imported);

// World positions become the floats of the bake, here and nowhere else, in a frame of the
// scene's own (WorldFrame) with +Y up and `camera` at its origin: so the picture is the same
// wherever the scene stands and however large it is. Where the file's own numbers are too
// coarse for the scene they describe, the report says so.
[[nodiscard]] Scene scene_in_float(ImportedScene imported,
                                   const NamedCamera& camera,
                                   UpAxis up_axis);

}  // namespace relume::scene
