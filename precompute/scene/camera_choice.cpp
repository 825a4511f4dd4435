#include "precompute/scene/camera_choice.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"

#include <Imath/ImathBox.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace relume::scene {
namespace {

std::optional<std::uint32_t> index_from(const std::string& text) {
    std::uint32_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return index;
}

// A name counts before a number, so that a camera called `2` can be reached.
const NamedCamera& camera_called(const std::string& wanted, const ImportedScene& imported) {
    const std::vector<NamedCamera>& cameras = imported.cameras;
    const auto refuse = [&](const std::string& why) {
        throw SceneError(
            SceneFault::unknown_name,
            fmt::format("scene '{}': {} '{}'; its cameras:\n  {}",
                        shown_text(imported.scene.name), why, shown_text(wanted),
                        cameras.empty()
                            ? "none"
                            : fmt::format("{}", fmt::join(list_of(cameras), "\n  "))));
    };
    std::vector<const NamedCamera*> found;
    for (const NamedCamera& camera : cameras) {
        if (camera.name == shown_text(wanted) || camera.node_path == shown_text(wanted))
            found.push_back(&camera);
    }
    if (found.size() > 1)
        refuse(fmt::format("{} cameras are called", found.size()));
    if (found.size() == 1)
        return *found.front();
    const auto index = index_from(wanted);
    if (!index || *index >= cameras.size())
        refuse("there is no camera");
    return cameras[*index];
}

Imath::V3d unit(const Imath::V3d& v) {
    return v.normalized();
}

Imath::V3d direction_to(const std::string& name,
                        const Imath::V3d& eye,
                        const Imath::V3d& look_at) {
    const Imath::V3d view = look_at - eye;
    if (!(view.length() > 0) || !std::isfinite(view.length()))
        throw SceneError(SceneFault::bad_camera,
                         fmt::format("camera '{}': eye ({}, {}, {}) and look-at ({}, {}, {}); "
                                     "expected two different points",
                                     shown_text(name), eye.x, eye.y, eye.z, look_at.x,
                                     look_at.y, look_at.z));
    return unit(view);
}

Imath::Box3d bounds_of(const ImportedScene& imported) {
    Imath::Box3d box;
    for (std::size_t i = 0; i < imported.scene.meshes.size(); ++i) {
        for (const Triangle& triangle : imported.scene.meshes[i].triangles) {
            for (const std::uint32_t index : triangle) {
                if (index < imported.positions[i].size())
                    box.extendBy(imported.positions[i][index]);
            }
        }
    }
    return box;
}

// From the front, the right and above, at a distance from which the sphere around the scene
// just fits into the image.
NamedCamera camera_that_frames(const ImportedScene& imported,
                               double fov_degrees,
                               double aspect,
                               UpAxis up_axis) {
    const Imath::Box3d box = bounds_of(imported);
    NamedCamera camera{.name = "framing the scene", .vertical_fov_degrees = fov_degrees};
    camera.forward = file_axes_from(up_axis, unit(Imath::V3d(-0.5, -0.4, -1)));
    camera.up = file_axes_from(up_axis, Imath::V3d(0, 1, 0));
    if (box.isEmpty())
        return camera;
    const double radius = std::max(box.size().length() / 2, 1e-30);
    const double half_height = std::tan(camera.vertical_fov_degrees * std::numbers::pi / 360);
    const double narrower = std::atan(half_height * std::min(aspect, 1.0));
    camera.eye = box.center() - camera.forward * (radius / std::sin(narrower));
    return camera;
}

std::string options_for(const NamedCamera& camera, const Imath::V3d& look_at) {
    return fmt::format("--eye={},{},{} --look-at={},{},{} --up={},{},{} --fov={}", camera.eye.x,
                       camera.eye.y, camera.eye.z, look_at.x, look_at.y, look_at.z, camera.up.x,
                       camera.up.y, camera.up.z, camera.vertical_fov_degrees);
}

}  // namespace

std::vector<std::string> list_of(const std::vector<NamedCamera>& cameras) {
    std::vector<std::string> lines;
    for (const NamedCamera& camera : cameras)
        lines.push_back(
            fmt::format("{}: {} ({})", camera.index,
                        camera.name.empty() ? "without a name" : shown_text(camera.name),
                        shown_text(camera.node_path)));
    return lines;
}

NamedCamera choose_camera(const CameraRequest& request,
                          double aspect,
                          UpAxis up_axis,
                          ImportedScene& imported) {
    ImportReport& report = imported.scene.report;
    NamedCamera chosen;
    const bool is_framed = request.wanted.empty() && imported.cameras.empty();
    if (is_framed) {
        const double fov = request.vertical_fov_degrees.value_or(chosen.vertical_fov_degrees);
        chosen = camera_that_frames(imported, fov, aspect, up_axis);
    } else {
        chosen = request.wanted.empty() ? imported.cameras.front()
                                        : camera_called(request.wanted, imported);
    }
    if (request.wanted.empty() && !request.eye) {
        for (const NamedCamera& camera : imported.cameras) {
            if (camera.index != chosen.index)
                report.unused.push_back(
                    fmt::format("camera '{}': the first, '{}', is used; --camera chooses",
                                shown_text(camera.name), shown_text(chosen.name)));
        }
    }
    const Imath::V3d centre =
        is_framed && !bounds_of(imported).isEmpty() ? bounds_of(imported).center() : chosen.eye;
    if (request.eye || request.look_at) {
        chosen.name = "given";
        chosen.eye = request.eye.value_or(chosen.eye);
        if (request.look_at || is_framed)
            chosen.forward =
                direction_to(chosen.name, chosen.eye, request.look_at.value_or(centre));
    }
    if (request.up)
        chosen.up = unit(*request.up);
    chosen.vertical_fov_degrees =
        request.vertical_fov_degrees.value_or(chosen.vertical_fov_degrees);
    if (!std::isfinite(chosen.eye.length()) || !std::isfinite(chosen.up.length()))
        throw SceneError(SceneFault::bad_camera,
                         fmt::format("camera '{}': expected finite numbers for eye and up",
                                     shown_text(chosen.name)));
    if (is_framed && !(request.eye && request.look_at)) {
        const Imath::V3d look_at = request.look_at.value_or(centre);
        report.repairs.push_back(
            fmt::format("no camera in the file: one that frames the scene is used, the same as "
                        "{}",
                        options_for(chosen, look_at)));
    }
    return chosen;
}

CameraPlacement placed_as_asked(const CameraRequest& request, const CameraPlacement& base) {
    if (!request.wanted.empty())
        throw SceneError(SceneFault::unknown_name,
                         fmt::format("there is no camera '{}': a scene made by code has one, "
                                     "without a name",
                                     shown_text(request.wanted)));
    CameraPlacement camera = base;
    if (request.eye)
        camera.eye = Imath::V3f(*request.eye);
    if (request.look_at)
        camera.look_at = Imath::V3f(*request.look_at);
    if (request.up)
        camera.up = Imath::V3f(*request.up);
    if (request.vertical_fov_degrees)
        camera.vertical_fov_degrees = static_cast<float>(*request.vertical_fov_degrees);
    return camera;
}

}  // namespace relume::scene
