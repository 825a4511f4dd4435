#include "precompute/scene/ply/import_ply.h"

#include "precompute/scene/picture_files.h"
#include "precompute/scene/ply/ply_file.h"
#include "precompute/scene/polygons/add_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace relume::scene::ply {
namespace {

// Between neighbouring floats of the largest coordinate's size.
double single_step(const PolygonMesh& mesh) {
    double largest = 0;
    for (const Imath::V3d& p : mesh.positions)
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return std::isfinite(largest) ? largest * std::numeric_limits<float>::epsilon() : 0;
}

}  // namespace

ImportedScene import_ply(const std::filesystem::path& path, const ImportOptions& options) {
    PlyFile file = read_ply(path, options.max_file_bytes);
    ImportedScene imported;
    Scene& scene = imported.scene;
    scene.name = path.stem().string();
    if (file.has_single_positions)
        imported.position_step = single_step(file.mesh);
    if (file.short_faces > 0)
        scene.report.unused.push_back(fmt::format("{} points and lines", file.short_faces));
    if (file.has_face_colours && file.mesh.colours.empty())
        scene.report.unused.emplace_back("colours of faces");
    if (file.has_alpha)
        scene.report.unused.emplace_back("alpha of vertices (taken as opaque)");
    if (file.pictures.size() > 1)
        scene.report.unused.push_back(
            fmt::format("{} further texture files", file.pictures.size() - 1));
    Material material;
    material.name = "PLY";
    if (!file.mesh.colours.empty())
        material.base_colour = Imath::V3f(1);
    if (!file.pictures.empty() && !file.mesh.uvs.empty()) {
        PictureFiles pictures(std::filesystem::absolute(path).parent_path(),
                              options.max_textures, scene);
        if (const Texture* picture =
                pictures.picture(file.pictures[0], TextureContent::colour, "PLY")) {
            material.base_texture = pictures.add(*picture);
            material.base_colour = Imath::V3f(1);
        }
    }
    scene.materials.push_back(std::move(material));
    add_meshes(std::move(file.mesh), {}, options.max_triangles, imported);
    return imported;
}

}  // namespace relume::scene::ply
