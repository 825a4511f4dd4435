#include "precompute/scene/gltf/cameras.h"

#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace relume::scene::gltf {
namespace {

// The node's, for a camera is used by its node; else the camera's own.
std::string name_of(const tinygltf::Node& node, const tinygltf::Camera& camera) {
    return shown_text(original_bytes(node.name.empty() ? camera.name : node.name));
}

bool is_unit(const Imath::V3d& direction) {
    return std::abs(direction.length() - 1.0) < 1e-6;  // false for NaN
}

bool is_finite(const Imath::V3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void import_cameras(const Document& document, const Nodes& nodes, ImportedScene& imported) {
    const tinygltf::Model& model = document.model;
    std::vector<std::string>& unused = imported.scene.report.unused;
    std::vector<bool> is_used(model.cameras.size(), false);
    for (const std::size_t index : nodes.shown()) {
        const tinygltf::Node& node = model.nodes[index];
        if (node.camera < 0)
            continue;
        const std::size_t number = document.file.checked_index(
            node.camera, model.cameras.size(), label("node", index, node.name), "camera");
        const tinygltf::Camera& camera = model.cameras[number];
        is_used[number] = true;
        const std::string name = name_of(node, camera);
        const auto leave_out = [&](const std::string& why) {
            unused.push_back(fmt::format("camera '{}' of {}: {}", name,
                                         label("node", index, node.name), why));
        };
        if (camera.type != "perspective") {
            leave_out(camera.type == "orthographic" ? "orthographic" : "of no known type");
            continue;
        }
        const double fov = camera.perspective.yfov;
        if (!(fov > 0 && fov < std::numbers::pi)) {
            leave_out(fmt::format("yfov of {} radians; expected 0 < yfov < π", fov));
            continue;
        }
        const Affine& world = nodes.world(index);
        // Rows of a node that is scaled to a point or beyond all numbers give no directions.
        const NamedCamera placed{.name = name,
                                 .node_path = nodes.path(index),
                                 .index = static_cast<std::uint32_t>(imported.cameras.size()),
                                 .eye = row(world, 3),
                                 .forward = -row(world, 2).normalized(),
                                 .up = row(world, 1).normalized(),
                                 .vertical_fov_degrees = fov * 180.0 / std::numbers::pi};
        if (!is_unit(placed.forward) || !is_unit(placed.up) || !is_finite(placed.eye)) {
            leave_out("its node gives it no direction");
            continue;
        }
        imported.cameras.push_back(placed);
    }
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        if (!is_used[i])
            unused.push_back(label("camera", i, model.cameras[i].name) +
                             ": no node of the scene has it");
    }
}

}  // namespace relume::scene::gltf
