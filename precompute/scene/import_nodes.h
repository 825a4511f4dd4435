// The node tree of an assimp scene: instances flattened into world space, the camera found.
#pragma once

#include "precompute/scene/scene.h"

#include <cstdint>
#include <optional>

struct aiScene;

namespace relume::scene {

// One Mesh per node and mesh that hangs on it. Throws SceneError (too_large).
void import_meshes(const aiScene& source,
                   std::uint64_t max_triangles,
                   std::uint32_t max_nodes,
                   Scene& scene);

// The first perspective camera; the others are named in the report.
[[nodiscard]] std::optional<CameraPlacement> import_camera(const aiScene& source,
                                                           ImportReport& report);

}  // namespace relume::scene
