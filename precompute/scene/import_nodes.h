// The node tree of an assimp scene: instances flattened into world space.
#pragma once

#include "precompute/scene/imported_scene.h"

#include <cstdint>

struct aiScene;

namespace relume::scene {

// One Mesh per node and mesh that hangs on it. Throws SceneError (too_large).
void import_meshes(const aiScene& source,
                   std::uint64_t max_triangles,
                   std::uint32_t max_nodes,
                   ImportedScene& imported);

}  // namespace relume::scene
