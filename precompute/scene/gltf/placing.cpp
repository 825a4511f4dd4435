#include "precompute/scene/gltf/placing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace relume::scene::gltf {

void place(PrimitiveShape shape,
           std::span<const Affine> to_world,
           const std::string& name,
           ImportedScene& imported) {
    Mesh& mesh = shape.mesh;
    mesh.name = name;
    const auto map_of = [&](std::size_t vertex) -> const Affine& {
        return to_world[to_world.size() == 1 ? 0 : vertex];
    };
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        const Imath::V3d& p = shape.positions[i];
        const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        // The file's numbers are floats; those of a node are doubles.
        imported.position_step =
            std::max(imported.position_step, largest * std::numeric_limits<float>::epsilon() *
                                                 std::cbrt(std::abs(determinant(map_of(i)))));
        shape.positions[i] = point_through(map_of(i), p);
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        mesh.normals[i] =
            Imath::V3f(normal_through(map_of(i), Imath::V3d(mesh.normals[i])).normalized());
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        Imath::V4f& tangent = mesh.tangents[i];
        const Imath::V3f t(
            direction_through(map_of(i), Imath::V3d(tangent.x, tangent.y, tangent.z))
                .normalized());
        const float side = determinant(map_of(i)) < 0 ? -tangent.w : tangent.w;
        tangent = {t.x, t.y, t.z, side};
    }
    for (Triangle& triangle : mesh.triangles) {
        if (determinant(map_of(triangle[0])) < 0)
            std::swap(triangle[1], triangle[2]);
    }
    imported.scene.meshes.push_back(std::move(mesh));
    imported.positions.push_back(std::move(shape.positions));
}

}  // namespace relume::scene::gltf
