// Scenes of a few triangles, and lights that are a formula.
#pragma once

#include "precompute/bake/receivers/vertex/surface_probe.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/scene.h"

#include <functional>
#include <utility>
#include <vector>

namespace relume::bake {

// Seen from far away, of materials without textures.
inline scene::Scene scene_of(std::vector<scene::Mesh> meshes, std::size_t materials = 1) {
    scene::Scene scene;
    scene.name = "small";
    scene.meshes = std::move(meshes);
    scene.materials.resize(materials);
    scene.camera.eye = {0, 30, 40};
    return scene;
}

inline scene::Mesh box_mesh(const Imath::V3f& centre,
                            const Imath::V3f& size,
                            std::uint32_t material = 0) {
    scene::MeshBuilder builder("box", material);
    builder.add_box(centre, size);
    return builder.take();
}

inline scene::Mesh ball_mesh(std::uint32_t segments) {
    scene::MeshBuilder builder("ball", 0);
    builder.add_sphere({0, 0, 0}, 1, segments);
    return builder.take();
}

// A square of the given side in y = 0.
inline scene::Mesh square_mesh(float side) {
    const float h = side / 2;
    scene::MeshBuilder builder("square", 0);
    builder.add_quad({-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h});
    return builder.take();
}

// Three pages at one edge, from (0, 0, 0) to (0, 0, 2).
inline scene::Mesh book_mesh() {
    scene::Mesh mesh;
    mesh.name = "book";
    mesh.positions = {{0, 0, 0}, {0, 0, 2}, {2, 0, 1}, {0, 2, 1}, {-2, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    return mesh;
}

// Rows of one number.
class FormulaProbe final : public SurfaceProbe {
  public:
    explicit FormulaProbe(std::function<float(const ProbePoint&)> formula)
        : formula_(std::move(formula)) {}

    [[nodiscard]] std::size_t row_size() const override { return 1; }
    std::uint64_t write_row(const ProbePoint& point, std::span<float> row) const override {
        row[0] = formula_(point);
        return 1;
    }

  private:
    std::function<float(const ProbePoint&)> formula_;
};

}  // namespace relume::bake
