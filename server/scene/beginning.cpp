#include "server/scene/beginning.h"

#include "server/view/mesh/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::served {
namespace {

double fov_degrees_of(const transport::CameraRecord& camera) {
    constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
    return 2 * std::atan(double{camera.tan_half_height}) * kDegreesPerRadian;
}

// Of what the camera sees in the middle of its image, in the frame of the mesh; infinite where
// that is nothing.
double depth_in_the_middle(const transport::CameraRecord& camera,
                           const transport::SurfaceMesh& mesh) {
    const view::Pinhole pinhole{.eye = Imath::V3d(camera.eye),
                                .right = Imath::V3d(camera.right),
                                .up = Imath::V3d(camera.up),
                                .forward = Imath::V3d(camera.forward),
                                .tan_half_width = camera.tan_half_width,
                                .tan_half_height = camera.tan_half_height};
    view::VisibleSurface visible;
    visible.look(mesh, pinhole, 1, 1);
    return 1 / double{visible.nearness(0, 0)};
}

}  // namespace

view::Look beginning_of_image(const transport::Manifest& manifest) {
    const transport::CameraRecord& camera = manifest.camera;
    return {.eye = Imath::V3d(camera.eye),
            .look_at = Imath::V3d(camera.eye) + Imath::V3d(camera.forward),
            .up = Imath::V3d(camera.up),
            .fov_degrees = fov_degrees_of(camera),
            .width = manifest.image().width,
            .height = manifest.image().height};
}

view::Look beginning_of_mesh(const transport::Manifest& manifest,
                             const transport::SurfaceMesh& mesh,
                             const SceneBounds& bounds) {
    const transport::CameraRecord& camera = manifest.camera;
    const transport::FrameRecord& frame = manifest.mesh->frame;
    const Imath::V3d eye = frame.origin + Imath::V3d(camera.eye) * frame.unit;
    const Imath::V3d forward(camera.forward);
    double distance = depth_in_the_middle(camera, mesh) * frame.unit;
    if (!std::isfinite(distance)) {
        distance = std::max(forward.dot(bounds.centre - eye), 0.1 * bounds.radius);
    }
    return {.eye = eye,
            .look_at = eye + forward * distance,
            .up = Imath::V3d(camera.up),
            .fov_degrees = fov_degrees_of(camera),
            .width = manifest.mesh->view.width,
            .height = manifest.mesh->view.height};
}

}  // namespace relume::served
