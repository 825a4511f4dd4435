// Scenes that assimp reads: OBJ with MTL, PLY.
#pragma once

#include "precompute/scene/import.h"
#include "precompute/scene/import_materials.h"
#include "precompute/scene/imported_scene.h"

#include <filesystem>

namespace relume::scene {

// Throws SceneError; see SceneFault.
[[nodiscard]] ImportedScene import_with_assimp(const std::filesystem::path& path,
                                               FileFormat format,
                                               const ImportOptions& options);

}  // namespace relume::scene
