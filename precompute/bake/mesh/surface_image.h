// An image of a lit surface, computed plainly: rays through every pixel, and at each point the
// sum of the terms. What any faster view of it is checked against.
#pragma once

#include "protocol/transport/transport.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

struct SurfaceImage {
    transport::TileGrid size;
    std::vector<Imath::V3d> rgb;  // height·width, linear, premultiplied by coverage
    std::vector<float> coverage;  // height·width, in [0, 1]
};

// `values` are of the vertices, tint applied, [blocks][3][256]. The transport is of kind
// `mesh`, the camera in its frame. `side`² rays a pixel, spread evenly. Parallel and
// deterministic. Throws BakeError.
[[nodiscard]] SurfaceImage view_surface(const transport::Transport& transport,
                                        std::span<const double> values,
                                        const transport::CameraRecord& camera,
                                        const transport::TileGrid& size,
                                        std::uint32_t side);

}  // namespace relume::bake
