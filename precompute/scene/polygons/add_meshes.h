// From polygons to the meshes of a scene.
#pragma once

#include "precompute/scene/imported_scene.h"
#include "precompute/scene/polygons/polygon_mesh.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::scene {

// Texture coordinates as a texture wants them: uv' = scale·uv + offset.
struct UvTransform {
    Imath::V2f scale{1, 1};
    Imath::V2f offset{0, 0};

    [[nodiscard]] bool operator==(const UvTransform&) const = default;
};

// The sets of one material, at most kMaxUvSets; empty: the coordinates as they are.
using UvTransforms = std::vector<UvTransform>;

// Triangulates the polygons, makes the normals that are missing, and appends one mesh for each
// material that is used. `uv_sets[m]`: the sets that material m asks for. Throws SceneError
// (too_large) above `max_triangles`.
void add_meshes(PolygonMesh polygons,
                const std::vector<UvTransforms>& uv_sets,
                std::uint64_t max_triangles,
                ImportedScene& imported);

}  // namespace relume::scene
