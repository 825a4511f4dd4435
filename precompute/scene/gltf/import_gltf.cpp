#include "precompute/scene/gltf/import_gltf.h"

#include "precompute/scene/gltf/cameras.h"
#include "precompute/scene/gltf/container.h"
#include "precompute/scene/gltf/extensions.h"
#include "precompute/scene/gltf/instances.h"
#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/gltf/placing.h"
#include "precompute/scene/gltf/skins.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace relume::scene::gltf {
namespace {

// The parts of one import, in the order in which they lean on each other.
class Importer {
  public:
    Importer(const std::filesystem::path& path, const ImportOptions& options)
        : options_(options),
          file_(shown_text(path.string())),
          container_(path, file_),
          document_(parse_document(container_, file_)),
          resources_(
              file_, std::filesystem::absolute(path).parent_path(), options.max_file_bytes),
          views_(document_, container_, resources_),
          accessors_(document_, views_),
          nodes_(document_, options.max_nodes),
          textures_(document_, views_, resources_, options.max_textures, imported_.scene),
          materials_(document_, textures_, imported_.scene),
          primitives_(document_, views_, accessors_, materials_, imported_.scene.report) {
        imported_.scene.name = shown_text(path.stem().string());
    }

    ImportedScene import_all() {
        report_unused();
        import_cameras(document_, nodes_, imported_);
        import_meshes();
        report_left_out();
        if (imported_.scene.meshes.empty())
            file_.refuse(SceneFault::no_geometry,
                         "the scene that it shows holds no triangles; expected at least one");
        return std::move(imported_);
    }

  private:
    // Nodes that show the same shapes: one mesh, morphed alike, skinned or not.
    using ShapeKey = std::pair<std::size_t, std::pair<std::vector<double>, bool>>;

    void import_meshes();
    void import_primitives(const ShapeKey& key, const std::vector<std::size_t>& users);
    void place_for(std::size_t node, const PrimitiveShape& shape, const std::string& who);
    void count_triangles(std::size_t more);
    void report_unused();
    void report_left_out();

    const ImportOptions& options_;
    FileName file_;
    Container container_;
    Document document_;
    Resources resources_;
    BufferViews views_;
    Accessors accessors_;
    Nodes nodes_;
    ImportedScene imported_{};
    Textures textures_;
    Materials materials_;
    PrimitiveReader primitives_;
    std::map<std::size_t, std::vector<Affine>> joint_maps_{};  // by skin
    std::uint64_t triangles_ = 0;
    std::uint64_t instances_ = 0;
};

void Importer::import_meshes() {
    const tinygltf::Model& model = document_.model;
    std::map<ShapeKey, std::vector<std::size_t>> users;
    std::vector<ShapeKey> in_order;
    for (const std::size_t index : nodes_.shown()) {
        const tinygltf::Node& node = model.nodes[index];
        if (node.mesh < 0)
            continue;
        const std::string self = label("node", index, node.name);
        const std::size_t mesh =
            file_.checked_index(node.mesh, model.meshes.size(), self, "mesh");
        if (node.skin >= 0)
            (void)file_.checked_index(node.skin, model.skins.size(), self, "skin");
        const std::vector<double>& weights =
            node.weights.empty() ? model.meshes[mesh].weights : node.weights;
        const ShapeKey key{mesh, {weights, node.skin >= 0}};
        std::vector<std::size_t>& of_key = users[key];
        if (of_key.empty())
            in_order.push_back(key);
        of_key.push_back(index);
    }
    for (const ShapeKey& key : in_order)
        import_primitives(key, users[key]);
}

void Importer::import_primitives(const ShapeKey& key, const std::vector<std::size_t>& users) {
    const tinygltf::Mesh& mesh = document_.model.meshes[key.first];
    const auto& [weights, is_skinned] = key.second;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const std::string who =
            fmt::format("primitive {} of {}", i, label("mesh", key.first, mesh.name));
        const auto shape = primitives_.read(mesh.primitives[i], weights, is_skinned, who);
        if (!shape)
            continue;
        for (const std::size_t node : users)
            place_for(node, *shape, who);
    }
}

void Importer::place_for(std::size_t index,
                         const PrimitiveShape& shape,
                         const std::string& who) {
    const tinygltf::Node& node = document_.model.nodes[index];
    const tinygltf::Mesh& mesh = document_.model.meshes[static_cast<std::size_t>(node.mesh)];
    const std::string own = shown_text(original_bytes(node.name));
    const std::string name =
        mesh.name.empty() ? own : own + "/" + shown_text(original_bytes(mesh.name));
    if (shape.influences.per_vertex > 0) {
        const auto skin = static_cast<std::size_t>(node.skin);
        if (!joint_maps_.contains(skin))
            joint_maps_[skin] = joint_maps(document_, skin, nodes_, accessors_);
        count_triangles(shape.mesh.triangles.size());
        const std::vector<Affine> maps =
            vertex_maps(shape.influences, joint_maps_[skin], file_, who);
        if (!maps.empty())
            place(shape, maps, name, imported_);
        return;
    }
    const std::vector<Affine> instances =
        instances_of(document_, index, accessors_, options_.max_nodes);
    instances_ += instances.size();
    if (instances_ > options_.max_nodes)
        file_.refuse(SceneFault::too_large,
                     fmt::format("more than {} instances of meshes", options_.max_nodes));
    count_triangles(shape.mesh.triangles.size() * instances.size());
    for (const Affine& instance : instances) {
        const Affine to_world = instance * nodes_.world(index);
        place(shape, {&to_world, 1}, name, imported_);
    }
}

void Importer::count_triangles(std::size_t more) {
    triangles_ += more;
    if (triangles_ > options_.max_triangles)
        file_.refuse(SceneFault::too_large,
                     fmt::format("more than {} triangles, instances counted one by one",
                                 options_.max_triangles));
}

void Importer::report_unused() {
    const tinygltf::Model& model = document_.model;
    std::vector<std::string>& unused = imported_.scene.report.unused;
    if (model.scenes.size() > 1) {
        const std::size_t shown = *nodes_.scene();
        unused.push_back(fmt::format("{} of {} scenes: {} is shown", model.scenes.size() - 1,
                                     model.scenes.size(),
                                     label("scene", shown, model.scenes[shown].name)));
    }
    for (std::size_t i = 0; i < model.lights.size(); ++i)
        unused.push_back(
            model.lights[i].name.empty()
                ? fmt::format("light {}", i)
                : fmt::format("light '{}'", shown_text(original_bytes(model.lights[i].name))));
    if (!model.animations.empty())
        unused.push_back(
            fmt::format("{} animations (the file's pose is shown)", model.animations.size()));
    for (const std::string& line : unused_extensions(document_.extensions))
        unused.push_back(line);
}

void Importer::report_left_out() {
    const LeftOut& left_out = primitives_.left_out();
    ImportReport& report = imported_.scene.report;
    if (left_out.points_and_lines > 0)
        report.unused.push_back(
            fmt::format("{} vertices of points and lines", left_out.points_and_lines));
    if (left_out.loose_indices > 0)
        report.repairs.push_back(
            fmt::format("{} indices after the last whole triangle of their lists dropped",
                        left_out.loose_indices));
    for (const Mesh& mesh : imported_.scene.meshes) {
        if (!mesh.triangles.empty() && mesh.normals.empty()) {
            report.repairs.emplace_back("meshes without normals are shaded flat");
            break;
        }
    }
}

}  // namespace

ImportedScene import_gltf(const std::filesystem::path& path, const ImportOptions& options) {
    return Importer(path, options).import_all();
}

}  // namespace relume::scene::gltf
