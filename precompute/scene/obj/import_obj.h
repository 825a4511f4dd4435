// Scenes from OBJ with MTL.
#pragma once

#include "precompute/scene/import.h"
#include "precompute/scene/imported_scene.h"

#include <filesystem>

namespace relume::scene::obj {

// Throws SceneError; see SceneFault.
[[nodiscard]] ImportedScene import_obj(const std::filesystem::path& path,
                                       const ImportOptions& options);

}  // namespace relume::scene::obj
