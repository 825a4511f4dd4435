#include "precompute/scene/gltf/affine.h"

#include <cmath>

namespace relume::scene::gltf {

Affine affine_from(const Imath::V3d& translation,
                   const Imath::V4d& rotation,
                   const Imath::V3d& scale) {
    const double length = std::sqrt(rotation.dot(rotation));
    const Imath::V4d q = length > 0 ? rotation / length : Imath::V4d(0, 0, 0, 1);
    const double xx = q.x * q.x;
    const double yy = q.y * q.y;
    const double zz = q.z * q.z;
    // Rows are the images of the axes.
    const Imath::V3d x = Imath::V3d(1 - 2 * (yy + zz), 2 * (q.x * q.y + q.z * q.w),
                                    2 * (q.x * q.z - q.y * q.w)) *
                         scale.x;
    const Imath::V3d y = Imath::V3d(2 * (q.x * q.y - q.z * q.w), 1 - 2 * (xx + zz),
                                    2 * (q.y * q.z + q.x * q.w)) *
                         scale.y;
    const Imath::V3d z = Imath::V3d(2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w),
                                    1 - 2 * (xx + yy)) *
                         scale.z;
    return {x.x, x.y, x.z, 0, y.x,           y.y,           y.z,           0,
            z.x, z.y, z.z, 0, translation.x, translation.y, translation.z, 1};
}

}  // namespace relume::scene::gltf
