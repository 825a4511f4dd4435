#include "precompute/scene/polygons/add_meshes.h"

#include "precompute/scene/polygons/corner_normals.h"
#include "precompute/scene/polygons/triangulation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace relume::scene {
namespace {

struct HashCorner {
    std::size_t operator()(const std::array<std::uint32_t, 3>& c) const {
        std::uint64_t bits = c[0];
        for (const std::uint32_t part : {c[1], c[2]})
            bits = (bits ^ part) * 0x9E3779B97F4A7C15ULL + (bits >> 29U);
        return bits;
    }
};

// One material's mesh; equal corners become one vertex.
class MeshBuilder {
  public:
    MeshBuilder(const PolygonMesh& source, const UvTransforms& uv_sets, std::uint32_t material)
        : source_(source), uv_sets_(uv_sets) {
        mesh_.name = source.name;
        mesh_.material = material;
        if (!uv_sets.empty())
            mesh_.more_uvs.resize(uv_sets.size() - 1);
    }

    void add(const CornerTriangle& triangle) {
        mesh_.triangles.push_back({vertex(triangle.corner[0]), vertex(triangle.corner[1]),
                                   vertex(triangle.corner[2])});
    }

    void move_to(ImportedScene& imported) && {
        if (!has_uvs_) {
            mesh_.uvs.clear();
            mesh_.more_uvs.clear();
        }
        imported.scene.meshes.push_back(std::move(mesh_));
        imported.positions.push_back(std::move(positions_));
    }

  private:
    std::uint32_t vertex(std::uint32_t corner_index) {
        const PolygonCorner& corner = source_.corners[corner_index];
        const auto [known, is_new] =
            vertices_.try_emplace({corner.position, corner.uv, corner.normal},
                                  static_cast<std::uint32_t>(positions_.size()));
        if (is_new)
            append(corner);
        return known->second;
    }

    void append(const PolygonCorner& corner) {
        positions_.push_back(source_.positions[corner.position]);
        mesh_.normals.push_back(source_.normals[corner.normal].normalized());
        if (!source_.colours.empty())
            mesh_.colours.push_back(source_.colours[corner.position]);
        has_uvs_ = has_uvs_ || corner.uv != kNone;
        const Imath::V2f uv = corner.uv != kNone ? source_.uvs[corner.uv] : Imath::V2f(0);
        const auto moved = [&](std::size_t set) {
            return set < uv_sets_.size() ? uv * uv_sets_[set].scale + uv_sets_[set].offset : uv;
        };
        mesh_.uvs.push_back(moved(0));
        for (std::size_t set = 0; set < mesh_.more_uvs.size(); ++set)
            mesh_.more_uvs[set].push_back(moved(set + 1));
    }

    const PolygonMesh& source_;
    const UvTransforms& uv_sets_;
    Mesh mesh_;
    std::vector<Imath::V3d> positions_;
    std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, HashCorner> vertices_;
    bool has_uvs_ = false;
};

}  // namespace

void add_meshes(PolygonMesh polygons,
                const std::vector<UvTransforms>& uv_sets,
                std::uint64_t max_triangles,
                ImportedScene& imported) {
    std::vector<CornerTriangle> triangles = triangulated(polygons, max_triangles);
    if (add_missing_normals(polygons, triangles) > 0)
        imported.scene.report.repairs.emplace_back(
            "missing normals made: by the file's smoothing groups, elsewhere smooth up to 60 "
            "degree edges");
    std::stable_sort(triangles.begin(), triangles.end(),
                     [&](const CornerTriangle& a, const CornerTriangle& b) {
                         return polygons.polygons[a.polygon].material <
                                polygons.polygons[b.polygon].material;
                     });
    static const UvTransforms kAsTheyAre;
    std::size_t i = 0;
    while (i < triangles.size()) {
        const std::uint32_t material = polygons.polygons[triangles[i].polygon].material;
        MeshBuilder mesh(polygons, material < uv_sets.size() ? uv_sets[material] : kAsTheyAre,
                         material);
        for (; i < triangles.size() &&
               polygons.polygons[triangles[i].polygon].material == material;
             ++i)
            mesh.add(triangles[i]);
        std::move(mesh).move_to(imported);
    }
}

}  // namespace relume::scene
