#include "server/scene/scene_bounds.h"

#include <Imath/ImathBox.h>

#include <algorithm>
#include <cmath>

namespace relume::served {

SceneBounds bounds_of(const transport::SurfaceMesh& mesh, const transport::FrameRecord& frame) {
    Imath::Box3d box;
    for (const Imath::V3f& position : mesh.positions) {
        box.extendBy(Imath::V3d(position));
    }
    const Imath::V3d centre = box.center();
    double square = 0;
    for (const Imath::V3f& position : mesh.positions) {
        square = std::max(square, (Imath::V3d(position) - centre).length2());
    }
    return {.centre = frame.origin + centre * frame.unit,
            .radius = std::sqrt(square) * frame.unit};
}

}  // namespace relume::served
