// Scenes from glTF 2.0 and GLB, through tinygltf, Draco and meshoptimizer.
#pragma once

#include "precompute/scene/import.h"
#include "precompute/scene/imported_scene.h"

#include <filesystem>

namespace relume::scene::gltf {

// Throws SceneError; see SceneFault.
[[nodiscard]] ImportedScene import_gltf(const std::filesystem::path& path,
                                        const ImportOptions& options);

}  // namespace relume::scene::gltf
