// A scene as the bake sees it: triangles, materials, textures, one camera, and where they lie
// in the world.
#pragma once

#include "precompute/scene/camera.h"
#include "precompute/scene/material.h"
#include "precompute/scene/mesh.h"
#include "precompute/scene/texture.h"

#include <Imath/ImathBox.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene {

// What a person must know who compares the picture with the file.
struct ImportReport {
    std::vector<std::string> unused;  // in the file, but no part of the bake: lights, skins, …
    std::vector<std::string> repairs;  // changed on the way in: degenerate triangles dropped, …
};

// Where the floats of a scene lie in the world of its file, turned so that +Y is up:
// world = origin + unit · position. A scene from a file has its origin at the camera, so that
// floats are finest where they are seen, and a unit of its own size; one made by code has the
// world's.
struct WorldFrame {
    Imath::V3d origin{0, 0, 0};
    double unit = 1;  // a power of two: scaling by it rounds nothing

    [[nodiscard]] Imath::V3d world_from_position(const Imath::V3f& position) const {
        return origin + Imath::V3d(position) * unit;
    }
};

// Read-only after import: all const members and free functions on it are thread-safe.
struct Scene {
    std::string name;
    std::vector<Mesh> meshes;  // at least one, none empty
    std::vector<Material> materials;
    std::vector<Texture> textures;
    WorldFrame frame;
    CameraPlacement camera;  // in `frame`
    ImportReport report;

    [[nodiscard]] std::size_t triangle_count() const;
    [[nodiscard]] std::size_t vertex_count() const;
    [[nodiscard]] Imath::Box3f bounds() const;  // in the world
};

// Checks and repairs what every scene must satisfy, whatever it came from: indices in range,
// vertices finite, degenerate triangles dropped (and counted in the report), empty meshes
// removed, normals unit or regenerated, tangents there where a normal map needs them. Throws
// SceneError.
void finish_scene(Scene& scene);

}  // namespace relume::scene
