#include "precompute/scene/imported_scene.h"

#include <cstddef>
#include <utility>

namespace relume::scene {

CameraPlacement placement_of(const NamedCamera& camera) {
    return {.name = camera.name,
            .eye = Imath::V3f(camera.eye),
            .look_at = Imath::V3f(camera.eye + camera.forward),
            .up = Imath::V3f(camera.up),
            .vertical_fov_degrees = static_cast<float>(camera.vertical_fov_degrees)};
}

Scene scene_in_float(ImportedScene imported) {
    for (std::size_t i = 0; i < imported.scene.meshes.size(); ++i) {
        std::vector<Imath::V3f>& floats = imported.scene.meshes[i].positions;
        floats.reserve(imported.positions[i].size());
        for (const Imath::V3d& position : imported.positions[i])
            floats.emplace_back(position);
        imported.positions[i] = {};
    }
    return std::move(imported.scene);
}

}  // namespace relume::scene
