// How large a scene is, and where.
#pragma once

#include "protocol/transport/mesh_section.h"
#include "protocol/transport/surface_mesh.h"

#include <Imath/ImathVec.h>

namespace relume::served {

// A sphere in the world.
struct SceneBounds {
    Imath::V3d centre{0, 0, 0};
    double radius = 0;
};

// Around all vertices.
[[nodiscard]] SceneBounds bounds_of(const transport::SurfaceMesh& mesh,
                                    const transport::FrameRecord& frame);

}  // namespace relume::served
