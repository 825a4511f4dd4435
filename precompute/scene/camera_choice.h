// Which camera a scene is seen by.
#pragma once

#include "precompute/scene/imported_scene.h"
#include "precompute/scene/up_axis.h"

#include <Imath/ImathVec.h>

#include <optional>
#include <string>
#include <vector>

namespace relume::scene {

// What a person asks of the camera, in the file's own coordinates; what is left out is the
// file's.
struct CameraRequest {
    std::string wanted{};  // name, node path or index of a camera of the file; empty: the first
    std::optional<Imath::V3d> eye{};
    std::optional<Imath::V3d> look_at{};
    std::optional<Imath::V3d> up{};
    std::optional<double> vertical_fov_degrees{};
};

// The camera asked for. A file without cameras is framed whole, for an image `aspect` times as
// wide as high, and the report says by which options. Notes the file's other cameras there.
// Throws SceneError: unknown_name for a camera that is not there or a name that several have,
// with those there are; bad_camera for an eye that is the point looked at.
[[nodiscard]] NamedCamera choose_camera(const CameraRequest& request,
                                        double aspect,
                                        UpAxis up_axis,
                                        ImportedScene& imported);

// The same for a scene made by code, whose own camera is the base. Throws SceneError.
[[nodiscard]] CameraPlacement placed_as_asked(const CameraRequest& request,
                                              const CameraPlacement& base);

// `2: Camera.001 (Scene/Rig/Camera.001)`, one for each.
[[nodiscard]] std::vector<std::string> list_of(const std::vector<NamedCamera>& cameras);

}  // namespace relume::scene
