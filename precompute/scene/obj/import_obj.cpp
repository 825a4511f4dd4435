#include "precompute/scene/obj/import_obj.h"

#include "precompute/scene/error.h"
#include "precompute/scene/import_folder.h"
#include "precompute/scene/obj/materials.h"
#include "precompute/scene/obj/mtl_file.h"
#include "precompute/scene/obj/obj_file.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/text_lines.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relume::scene::obj {
namespace {

namespace fs = std::filesystem;

class Libraries {
  public:
    Libraries(fs::path folder, std::uint64_t max_bytes, ImportReport& report)
        : folder_(std::move(folder)), max_bytes_(max_bytes), report_(report) {}

    // A statement names one file, whose name may hold blanks, or several.
    void read(std::string_view statement) {
        if (const auto path = file_meant(folder_, unquoted(statement))) {
            read_file(*path);
            return;
        }
        std::string_view rest = statement;
        std::vector<fs::path> found;
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            if (const auto path = file_meant(folder_, std::string(word)))
                found.push_back(*path);
            else if (statement != word)
                missing_.emplace_back(word);
        }
        if (found.empty())
            missing_ = {unquoted(statement)};
        for (const std::string& name : missing_)
            report_.unused.push_back(fmt::format(
                "material library '{}' ({})", shown_text(name),
                path_inside(folder_, name) ? "no such file" : "outside the scene's folder"));
        missing_.clear();
        for (const fs::path& path : found)
            read_file(path);
    }

    // Null where no library has it.
    [[nodiscard]] const MtlMaterial* material(const std::string& name) const {
        const auto found = materials_.find(name);
        return found != materials_.end() ? &found->second : nullptr;
    }

  private:
    static std::string unquoted(std::string_view text) {
        if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
            text = text.substr(1, text.size() - 2);
        return std::string(text);
    }

    void read_file(const fs::path& path) {
        for (MtlMaterial& material : read_mtl(path, max_bytes_)) {
            const std::string name = material.name;
            materials_.insert_or_assign(name, std::move(material));
        }
    }

    fs::path folder_;
    std::uint64_t max_bytes_;
    ImportReport& report_;
    std::map<std::string, MtlMaterial> materials_;
    std::vector<std::string> missing_;
};

// White where vertices bring their own colours, else grey.
Material without_library(const std::string& name, bool has_colours) {
    Material material;
    material.name = shown_text(name);
    if (has_colours)
        material.base_colour = Imath::V3f(1);
    return material;
}

}  // namespace

ImportedScene import_obj(const fs::path& path, const ImportOptions& options) {
    ImportedScene imported;
    Scene& scene = imported.scene;
    scene.name = path.stem().string();
    ObjFile file = read_obj(path, options.max_file_bytes);
    if (file.mesh.polygons.empty())
        throw SceneError(SceneFault::no_geometry,
                         fmt::format("scene '{}' holds {} vertices, {} points and lines and no "
                                     "faces; expected at least one face",
                                     shown_text(path.string()), file.mesh.positions.size(),
                                     file.points_and_lines));
    if (file.points_and_lines > 0)
        scene.report.unused.push_back(
            fmt::format("{} points and lines", file.points_and_lines));
    if (file.has_free_forms)
        scene.report.unused.emplace_back("curves and surfaces (free-form)");
    if (file.has_byte_colours)
        scene.report.repairs.emplace_back("vertex colours beyond 1 are taken as 0 to 255");
    const fs::path folder = fs::absolute(path).parent_path();
    Libraries libraries(folder, options.max_file_bytes, scene.report);
    for (const std::string& statement : file.libraries)
        libraries.read(statement);
    PictureFiles pictures(folder, options.max_textures, scene);
    Materials materials(pictures, scene);
    std::vector<UvTransforms> uv_sets;
    const bool has_colours = !file.mesh.colours.empty();
    for (const std::string& name : file.materials) {
        const MtlMaterial* source = libraries.material(name);
        if (source == nullptr) {
            if (!name.empty())
                scene.report.unused.push_back(
                    fmt::format("material '{}' is in no library: its surfaces are plain",
                                shown_text(name)));
            scene.materials.push_back(without_library(name, has_colours));
            uv_sets.emplace_back();
            continue;
        }
        ObjMaterial made = materials.from_mtl(*source);
        if (has_colours && !source->diffuse && !made.material.base_texture)
            made.material.base_colour = Imath::V3f(1);
        scene.materials.push_back(std::move(made.material));
        uv_sets.push_back(std::move(made.uv_sets));
    }
    add_meshes(std::move(file.mesh), uv_sets, options.max_triangles, imported);
    return imported;
}

}  // namespace relume::scene::obj
