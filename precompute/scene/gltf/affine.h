// Affine maps in double precision: what nodes, instances and joints are made of.
#pragma once

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

namespace relume::scene::gltf {

// Rows as Imath has them: a point is a row vector from the left, so that a child's map times
// its parent's is the child's to the world. A matrix of the file, column by column, is the same
// sixteen numbers in order.
using Affine = Imath::M44d;

[[nodiscard]] inline Imath::V3d point_through(const Affine& m, const Imath::V3d& p) {
    return {p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
            p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
            p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2]};
}

// Tangents go with the map itself.
[[nodiscard]] inline Imath::V3d direction_through(const Affine& m, const Imath::V3d& d) {
    return {d.x * m[0][0] + d.y * m[1][0] + d.z * m[2][0],
            d.x * m[0][1] + d.y * m[1][1] + d.z * m[2][1],
            d.x * m[0][2] + d.y * m[1][2] + d.z * m[2][2]};
}

[[nodiscard]] inline Imath::V3d row(const Affine& m, int i) {
    return {m[i][0], m[i][1], m[i][2]};
}

// Below zero where the map mirrors.
[[nodiscard]] inline double determinant(const Affine& m) {
    return row(m, 0).dot(row(m, 1).cross(row(m, 2)));
}

// Normals go with the inverse transpose: the cofactors with the determinant's sign, so that no
// inverse is needed and a mirrored surface keeps its outside.
[[nodiscard]] inline Imath::V3d normal_through(const Affine& m, const Imath::V3d& n) {
    const Imath::V3d yz = row(m, 1).cross(row(m, 2));
    const Imath::V3d zx = row(m, 2).cross(row(m, 0));
    const Imath::V3d xy = row(m, 0).cross(row(m, 1));
    const double side = row(m, 0).dot(yz) < 0 ? -1.0 : 1.0;
    return (yz * n.x + zx * n.y + xy * n.z) * side;
}

// Scale, then rotation by the quaternion (x, y, z, w) made unit, then translation.
[[nodiscard]] Affine affine_from(const Imath::V3d& translation,
                                 const Imath::V4d& rotation,
                                 const Imath::V3d& scale);

}  // namespace relume::scene::gltf
