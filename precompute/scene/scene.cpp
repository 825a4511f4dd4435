#include "precompute/scene/scene.h"

#include "precompute/scene/error.h"
#include "precompute/scene/tangents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relume::scene {
namespace {

// Embree gives up near 1.8e18; a squared length must still fit a float.
constexpr float kFarthestCoordinate = 1e15F;
// Below this height relative to its longest edge a triangle has no direction in float.
constexpr double kFlattest = 1e-8;

bool is_usable(const Imath::V3f& p) {
    return std::abs(p.x) <= kFarthestCoordinate && std::abs(p.y) <= kFarthestCoordinate &&
           std::abs(p.z) <= kFarthestCoordinate;  // false for NaN
}

Imath::V3d cross_of(const Mesh& mesh, const Triangle& triangle) {
    const Imath::V3d p0(mesh.positions[triangle[0]]);
    return (Imath::V3d(mesh.positions[triangle[1]]) - p0)
        .cross(Imath::V3d(mesh.positions[triangle[2]]) - p0);
}

bool is_degenerate(const Mesh& mesh, const Triangle& triangle) {
    const Imath::V3d p0(mesh.positions[triangle[0]]);
    const Imath::V3d p1(mesh.positions[triangle[1]]);
    const Imath::V3d p2(mesh.positions[triangle[2]]);
    const double longest2 =
        std::max({(p1 - p0).length2(), (p2 - p1).length2(), (p0 - p2).length2()});
    return !(cross_of(mesh, triangle).length() > kFlattest * longest2);
}

void check_mesh(const Scene& scene, const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    const auto refuse = [&](SceneFault fault, const std::string& why) {
        throw SceneError(fault,
                         fmt::format("scene '{}', mesh '{}': {}", scene.name, mesh.name, why));
    };
    for (std::size_t i = 0; i < count; ++i) {
        const Imath::V3f& p = mesh.positions[i];
        if (!is_usable(p))
            refuse(SceneFault::non_finite_vertex,
                   fmt::format("vertex {} is ({}, {}, {}); expected finite numbers up to {:g}",
                               i, p.x, p.y, p.z, kFarthestCoordinate));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::uint32_t index : mesh.triangles[i]) {
            if (index >= count)
                refuse(SceneFault::index_out_of_range,
                       fmt::format("triangle {} refers to vertex {}; expected below {}", i,
                                   index, count));
        }
    }
    const auto check_length = [&](std::size_t size, const char* what) {
        if (size != 0 && size != count)
            refuse(SceneFault::corrupt_file,
                   fmt::format("{} {} for {} vertices", size, what, count));
    };
    check_length(mesh.normals.size(), "normals");
    check_length(mesh.tangents.size(), "tangents");
    check_length(mesh.uvs.size(), "texture coordinates");
    for (const std::vector<Imath::V2f>& set : mesh.more_uvs)
        check_length(set.size(), "further texture coordinates");
    check_length(mesh.colours.size(), "colours");
    check_length(mesh.opacities.size(), "opacities");
    if (mesh.material >= scene.materials.size())
        refuse(SceneFault::index_out_of_range,
               fmt::format("material {}; expected below {}", mesh.material,
                           scene.materials.size()));
}

bool is_unit(const Imath::V3f& normal) {
    return std::abs(normal.length2() - 1.0F) < 1e-3F;
}

// Normals that are no directions are replaced by the mean of the faces around them. Returns
// their count.
std::size_t repair_normals(Mesh& mesh) {
    std::size_t repaired = 0;
    std::vector<Imath::V3d> around;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        if (is_unit(mesh.normals[i]))
            continue;
        const float length = mesh.normals[i].length();
        if (std::isfinite(length) && length > 1e-6F) {
            mesh.normals[i] /= length;
            continue;  // scaled, its direction stands
        }
        if (around.empty()) {
            around.assign(mesh.positions.size(), Imath::V3d(0, 0, 0));
            for (const Triangle& triangle : mesh.triangles) {
                for (const std::uint32_t index : triangle)
                    around[index] += cross_of(mesh, triangle);
            }
        }
        const double mean = around[i].length();
        mesh.normals[i] = mean > 0 ? Imath::V3f(around[i] / mean) : Imath::V3f(0, 1, 0);
        ++repaired;
    }
    return repaired;
}

template <typename Value>
std::size_t repair_non_finite(std::vector<Value>& values, const Value& replacement) {
    std::size_t repaired = 0;
    for (Value& value : values) {
        if (std::isfinite(value.length2()))
            continue;
        value = replacement;
        ++repaired;
    }
    return repaired;
}

bool are_usable(const std::vector<Imath::V4f>& tangents) {
    return std::all_of(tangents.begin(), tangents.end(), [](const Imath::V4f& t) {
        return std::abs(t.x * t.x + t.y * t.y + t.z * t.z - 1.0F) < 1e-3F &&
               std::abs(t.w) == 1.0F;
    });
}

// Tangents of the file are kept where they are directions, made where a normal map needs them.
void finish_tangents(const Material& material, Mesh& mesh) {
    if (!material.normal_texture) {
        mesh.tangents.clear();
    } else if (mesh.tangents.empty() || mesh.normals.empty() || !are_usable(mesh.tangents)) {
        add_tangents(mesh, material.normal_texture->uv_set);
    }
}

}  // namespace

std::size_t Scene::triangle_count() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes)
        count += mesh.triangles.size();
    return count;
}

std::size_t Scene::vertex_count() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes)
        count += mesh.positions.size();
    return count;
}

Imath::Box3f Scene::bounds() const {
    Imath::Box3f box;
    for (const Mesh& mesh : meshes) {
        for (const Imath::V3f& position : mesh.positions)
            box.extendBy(Imath::V3f(frame.world_from_position(position)));
    }
    return box;
}

void finish_scene(Scene& scene) {
    std::size_t given = 0;
    std::size_t dropped = 0;
    std::size_t normals = 0;
    std::size_t attributes = 0;
    for (Mesh& mesh : scene.meshes) {
        check_mesh(scene, mesh);
        given += mesh.triangles.size();
        dropped += std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
            return is_degenerate(mesh, triangle);
        });
        normals += repair_normals(mesh);
        attributes += repair_non_finite(mesh.uvs, Imath::V2f(0, 0));
        for (std::vector<Imath::V2f>& set : mesh.more_uvs)
            attributes += repair_non_finite(set, Imath::V2f(0, 0));
        attributes += repair_non_finite(mesh.colours, Imath::V3f(1, 1, 1));
        finish_tangents(scene.materials[mesh.material], mesh);
    }
    if (given == 0)
        throw SceneError(
            SceneFault::no_geometry,
            fmt::format("scene '{}' holds no triangles; expected at least one", scene.name));
    if (given == dropped)
        throw SceneError(SceneFault::all_degenerate,
                         fmt::format("scene '{}': all {} triangles are degenerate (no area)",
                                     scene.name, given));
    std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.triangles.empty(); });
    const auto note = [&](std::size_t count, const char* what) {
        if (count > 0)
            scene.report.repairs.push_back(fmt::format("{} {}", count, what));
    };
    note(dropped, "degenerate triangles dropped");
    note(normals, "zero or non-finite normals replaced by the mean of the faces around them");
    note(attributes, "non-finite texture coordinates or colours replaced by (0, 0) or white");
}

}  // namespace relume::scene
