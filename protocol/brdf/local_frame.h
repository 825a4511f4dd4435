// The frame in which BRDFs are factored, a function of the unit normal alone: a bake makes it
// at vertices and a view at pixels from the interpolated normal, and both mean the same
// directions. With r = (0.48, 0.60, 0.64):
//
//     tangent = normalise(r − n (n·r)), bitangent = n × tangent,
//     local(d) = (d·tangent, d·bitangent, d·n).
//
// Where r − n (n·r) is shorter than 1e-4, (1, 0, 0) takes the place of r: no field of tangents
// on the sphere is continuous, and this one turns at n = ±r alone. All functions are
// thread-safe.
#pragma once

#include "protocol/brdf/directions.h"

#include <Imath/ImathVec.h>

#include <cmath>

namespace relume::brdf {

struct Frame {
    Imath::V3f tangent, bitangent, normal;

    [[nodiscard]] Imath::V3f local_from_world(const Imath::V3f& d) const {
        return {d.x * tangent.x + d.y * tangent.y + d.z * tangent.z,
                d.x * bitangent.x + d.y * bitangent.y + d.z * bitangent.z,
                d.x * normal.x + d.y * normal.y + d.z * normal.z};
    }
    [[nodiscard]] Imath::V3f world_from_local(const Imath::V3f& d) const {
        return tangent * d.x + bitangent * d.y + normal * d.z;
    }
};

// An interpolated normal may face away from the viewer where the surface does not. A view then
// takes a direction whose z is this, so that the rim of a round object is not black.
inline constexpr float kLeastViewCosine = 1e-3F;

// `n` is a unit vector. Orthonormal and right-handed to rounding, which within 1e-3 of n = ±r
// is up to 1e-3.
[[nodiscard]] inline Frame local_frame(const Imath::V3f& n) {
    constexpr float kX = 0.48F;
    constexpr float kY = 0.60F;
    constexpr float kZ = 0.64F;
    constexpr float kShortest = 1e-4F;
    const float along = n.x * kX + n.y * kY + n.z * kZ;
    float x = kX - n.x * along;
    float y = kY - n.y * along;
    float z = kZ - n.z * along;
    // Selected without a branch, so that loops over many normals vectorise.
    const bool is_apart = x * x + y * y + z * z >= kShortest * kShortest;
    x = is_apart ? x : 1.0F - n.x * n.x;
    y = is_apart ? y : -n.y * n.x;
    z = is_apart ? z : -n.z * n.x;
    const float inverse = 1.0F / std::sqrt(x * x + y * y + z * z);
    const Imath::V3f t{x * inverse, y * inverse, z * inverse};
    return {t, {n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x}, n};
}

// out[i] = local_frame(normals[i]).local_from_world(directions[i]), with the same bits. All
// planes are of one length.
void local_from_world(const Directions& normals,
                      const Directions& directions,
                      const DirectionPlanes& out);

}  // namespace relume::brdf
