// Scenes from files: glTF 2.0 and GLB, OBJ with MTL, PLY.
#pragma once

#include "precompute/scene/camera_choice.h"
#include "precompute/scene/scene.h"
#include "precompute/scene/up_axis.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::scene {

struct ImportOptions {
    CameraRequest camera;
    double aspect = 1;  // width over height of the image, for a camera that frames the scene
    UpAxis up_axis = UpAxis::y;
    std::uint64_t max_file_bytes = std::uint64_t{4} << 30;
    std::uint64_t max_triangles = 50'000'000;  // after instances are flattened
    std::uint32_t max_nodes = 1'000'000;
    std::uint32_t max_textures = 1024;
};

// Textures are read from the scene's folder and below only. Throws SceneError; see SceneFault.
[[nodiscard]] Scene import_scene(const std::filesystem::path& path,
                                 const ImportOptions& options = {});

// The cameras of a scene file, in its order; may be empty. Throws SceneError.
[[nodiscard]] std::vector<NamedCamera> cameras_in(const std::filesystem::path& path,
                                                  const ImportOptions& options = {});

}  // namespace relume::scene
