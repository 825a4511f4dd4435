#include "precompute/scene/imported_scene.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"

#include <Imath/ImathBox.h>
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace relume::scene {
namespace {

// No scene is larger; numbers beyond it come from damaged files.
constexpr double kFarthestCoordinate = 1e15;
// Of the scene's size: a coarser grid of positions moves edges by visible amounts.
constexpr double kCoarsestStep = 1e-4;

// The power of two next to the geometric mean of the distances from the camera: of a scene
// with a far backdrop it is the near things that set the scale.
double unit_of(const ImportedScene& imported, const Imath::V3d& eye) {
    double sum = 0;
    std::size_t count = 0;
    for (const std::vector<Imath::V3d>& positions : imported.positions) {
        for (const Imath::V3d& position : positions) {
            const double distance = (position - eye).length();
            if (distance > 0) {
                sum += std::log2(distance);
                ++count;
            }
        }
    }
    return count > 0 ? std::exp2(std::round(sum / static_cast<double>(count))) : 1.0;
}

void note_coarse_positions(const ImportedScene& imported, ImportReport& report) {
    Imath::Box3d box;
    for (const std::vector<Imath::V3d>& positions : imported.positions) {
        for (const Imath::V3d& position : positions)
            box.extendBy(position);
    }
    if (box.isEmpty() || imported.position_step <= kCoarsestStep * box.size().length())
        return;
    report.repairs.push_back(fmt::format(
        "the file's numbers step by {:.2g} where its positions are largest, and the scene is "
        "{:.3g} across: surfaces are moved by as much and may pass through each other; export "
        "it near its origin, with the distance in a node's translation",
        imported.position_step, box.size().length()));
}

void turn(UpAxis up_axis, Mesh& mesh) {
    for (Imath::V3f& normal : mesh.normals)
        normal = y_up_from(up_axis, normal);
    for (Imath::V4f& tangent : mesh.tangents) {
        const Imath::V3f turned =
            y_up_from(up_axis, Imath::V3f(tangent.x, tangent.y, tangent.z));
        tangent = {turned.x, turned.y, turned.z, tangent.w};
    }
}

}  // namespace

void check_positions(const ImportedScene& imported) {
    for (std::size_t i = 0; i < imported.positions.size(); ++i) {
        for (std::size_t k = 0; k < imported.positions[i].size(); ++k) {
            const Imath::V3d& p = imported.positions[i][k];
            if (std::abs(p.x) <= kFarthestCoordinate && std::abs(p.y) <= kFarthestCoordinate &&
                std::abs(p.z) <= kFarthestCoordinate)
                continue;
            throw SceneError(
                SceneFault::non_finite_vertex,
                fmt::format("scene '{}', mesh '{}': vertex {} is ({}, {}, {}); expected finite "
                            "numbers up to {:g}",
                            shown_text(imported.scene.name),
                            shown_text(imported.scene.meshes[i].name), k, p.x, p.y, p.z,
                            kFarthestCoordinate));
        }
    }
}

Scene scene_in_float(ImportedScene imported, const NamedCamera& camera, UpAxis up_axis) {
    note_coarse_positions(imported, imported.scene.report);
    const WorldFrame frame{.origin = y_up_from(up_axis, camera.eye),
                           .unit = unit_of(imported, camera.eye)};
    for (std::size_t i = 0; i < imported.scene.meshes.size(); ++i) {
        Mesh& mesh = imported.scene.meshes[i];
        mesh.positions.reserve(imported.positions[i].size());
        for (const Imath::V3d& position : imported.positions[i])
            mesh.positions.emplace_back(y_up_from(up_axis, position - camera.eye) / frame.unit);
        imported.positions[i] = {};
        turn(up_axis, mesh);
    }
    imported.scene.frame = frame;
    // The eye is the frame's origin, so that the point looked at is the direction itself.
    imported.scene.camera = {
        .name = camera.name,
        .eye = {0, 0, 0},
        .look_at = Imath::V3f(y_up_from(up_axis, camera.forward)),
        .up = Imath::V3f(y_up_from(up_axis, camera.up)),
        .vertical_fov_degrees = static_cast<float>(camera.vertical_fov_degrees)};
    return std::move(imported.scene);
}

}  // namespace relume::scene
