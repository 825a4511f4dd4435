// Scenes from PLY.
#pragma once

#include "precompute/scene/import.h"
#include "precompute/scene/imported_scene.h"

#include <filesystem>

namespace relume::scene::ply {

// Throws SceneError; see SceneFault.
[[nodiscard]] ImportedScene import_ply(const std::filesystem::path& path,
                                       const ImportOptions& options);

}  // namespace relume::scene::ply
