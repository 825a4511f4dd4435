#include "precompute/scene/import.h"

#include "precompute/scene/error.h"
#include "precompute/scene/gltf/import_gltf.h"
#include "precompute/scene/imported_scene.h"
#include "precompute/scene/obj/import_obj.h"
#include "precompute/scene/ply/import_ply.h"
#include "precompute/scene/shown_text.h"
#include "protocol/base/text/near_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <string>
#include <system_error>
#include <utility>

namespace relume::scene {
namespace {

namespace fs = std::filesystem;

enum class FileFormat : std::uint8_t { gltf, obj, ply };

FileFormat format_of(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".gltf" || extension == ".glb")
        return FileFormat::gltf;
    if (extension == ".obj")
        return FileFormat::obj;
    if (extension == ".ply")
        return FileFormat::ply;
    throw SceneError(SceneFault::unsupported_format,
                     fmt::format("scene '{}': format '{}'; expected .gltf, .glb, .obj or .ply",
                                 path.string(), extension));
}

void check_file(const fs::path& path, std::uint64_t max_bytes) {
    std::error_code error;
    if (!fs::is_regular_file(path, error))
        throw SceneError(
            SceneFault::missing_file,
            fmt::format("scene '{}': {}", path.string(),
                        fs::exists(path, error) ? "expected a file, found something else"
                                                : text::text_from_missing_file(path)));
    const auto bytes = fs::file_size(path, error);
    if (error || bytes > max_bytes)
        throw SceneError(SceneFault::too_large,
                         fmt::format("scene '{}' has {} bytes; expected at most {}",
                                     path.string(), bytes, max_bytes));
}

ImportedScene read_by_format(const fs::path& path, const ImportOptions& options) {
    switch (format_of(path)) {
        case FileFormat::obj:
            return obj::import_obj(path, options);
        case FileFormat::ply:
            return ply::import_ply(path, options);
        default:
            return gltf::import_gltf(path, options);
    }
}

ImportedScene read_scene(const fs::path& path, const ImportOptions& options) {
    (void)format_of(path);
    check_file(path, options.max_file_bytes);
    ImportedScene imported = read_by_format(path, options);
    imported.scene.name = shown_text(imported.scene.name);
    check_positions(imported);
    return imported;
}

}  // namespace

Scene import_scene(const fs::path& path, const ImportOptions& options) {
    try {
        ImportedScene imported = read_scene(path, options);
        const NamedCamera camera =
            choose_camera(options.camera, options.aspect, options.up_axis, imported);
        Scene scene = scene_in_float(std::move(imported), camera, options.up_axis);
        finish_scene(scene);
        return scene;
    } catch (const std::bad_alloc&) {
        throw SceneError(SceneFault::too_large,
                         fmt::format("scene '{}' does not fit into memory", path.string()));
    }
}

std::vector<NamedCamera> cameras_in(const fs::path& path, const ImportOptions& options) {
    return read_scene(path, options).cameras;
}

}  // namespace relume::scene
