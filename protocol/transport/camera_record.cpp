#include "protocol/transport/camera_record.h"

#include "protocol/base/geometry/pinhole.h"

#include <array>
#include <cmath>
#include <utility>

namespace relume::transport {
namespace {

using nlohmann::json;

json json_from(const Imath::V3f& v) {
    return json::array({v.x, v.y, v.z});
}

// Axes of single precision; what rounding leaves of right angles and unit lengths is far below.
constexpr float kAxisTolerance = 1e-3F;

void require_orthonormal(const ManifestReader& object, const CameraRecord& camera) {
    const std::array<std::pair<const char*, Imath::V3f>, 3> axes{
        {{"right", camera.right}, {"up", camera.up}, {"forward", camera.forward}}};
    for (const auto& [name, axis] : axes) {
        if (!(std::abs(axis.length() - 1) <= kAxisTolerance)) {
            object.fail(name, fmt::format("a vector of length {}", axis.length()),
                        "a unit vector");
        }
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const auto& [name, axis] = axes[i];
        const auto& [other_name, other] = axes[(i + 1) % axes.size()];
        if (!(std::abs(axis.dot(other)) <= kAxisTolerance)) {
            object.fail(name, fmt::format("{}·{} = {}", name, other_name, axis.dot(other)),
                        "axes at right angles");
        }
    }
    for (const auto& [name, tangent] : {std::pair{"tan_half_width", camera.tan_half_width},
                                        std::pair{"tan_half_height", camera.tan_half_height}}) {
        if (!(tangent > 0)) {
            object.fail(name, fmt::format("{}", tangent), "a positive number");
        }
    }
}

}  // namespace

Imath::V3f CameraRecord::direction_from_pixel(float x, float y, const TileGrid& image) const {
    return geometry::Pinhole{right, up, forward, tan_half_width, tan_half_height}
        .direction_from_pixel(x, y, image.width, image.height);
}

json json_from(const CameraRecord& camera) {
    return {{"eye", json_from(camera.eye)},
            {"right", json_from(camera.right)},
            {"up", json_from(camera.up)},
            {"forward", json_from(camera.forward)},
            {"tan_half_width", camera.tan_half_width},
            {"tan_half_height", camera.tan_half_height}};
}

CameraRecord camera_record(const ManifestReader& object) {
    const CameraRecord camera{.eye = object.vector("eye"),
                              .right = object.vector("right"),
                              .up = object.vector("up"),
                              .forward = object.vector("forward"),
                              .tan_half_width = object.number("tan_half_width"),
                              .tan_half_height = object.number("tan_half_height")};
    require_orthonormal(object, camera);
    return camera;
}

}  // namespace relume::transport
