// The node tree of an assimp scene: instances flattened into world space, cameras found.
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

// Every perspective camera; the others are named in the report.
void import_cameras(const aiScene& source, ImportedScene& imported);

}  // namespace relume::scene
