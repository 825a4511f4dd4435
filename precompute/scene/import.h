// Scenes from files: glTF 2.0 and GLB, OBJ with MTL, PLY. Units as in the file; +Y up.
#pragma once

#include "precompute/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace relume::scene {

struct ImportOptions {
    std::optional<CameraPlacement> camera;  // overrides the file's
    std::uint64_t max_file_bytes = std::uint64_t{4} << 30;
    std::uint64_t max_triangles = 50'000'000;  // after instances are flattened
    std::uint32_t max_nodes = 1'000'000;
    std::uint32_t max_textures = 1024;
};

// Textures are read from the scene's folder and below only. Throws SceneError; see SceneFault.
[[nodiscard]] Scene import_scene(const std::filesystem::path& path,
                                 const ImportOptions& options = {});

}  // namespace relume::scene
