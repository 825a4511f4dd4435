// The angles that a curve of a BRDF may be a function of, and how each maps to u in [0, 1].
//
// Directions are unit vectors in the local frame, z along the normal, x along the tangent u, y
// along v; ωi points to the light, ωo to the viewer, both above the horizon, and h is the
// normalised ωi + ωo.
//
//     half         θ_h, between h and the normal                          u = √(θ/90°)
//     difference   θ_d, between ωi and h                                  u = θ/90°
//     incidence    θ_i, between ωi and the normal                         u = θ/90°
//     viewing      θ_o, between ωo and the normal                         u = θ/90°
//     reflection   between ωi and ωo mirrored in the normal, at most 90°  u = √(θ/90°)
//     along_u      θ_u with cos θ_u = (cos θ_h)^(cos² φ_h)                u = √(θ/90°)
//     along_v      θ_v with cos θ_v = (cos θ_h)^(sin² φ_h)                u = √(θ/90°)
//
// The root puts most samples where highlights are narrow, as measured tables do [Matusik03].
// The last two make the anisotropic lobe of [AshikhminShirley00], (n·h)^(n_u cos² φ_h + n_v
// sin² φ_h), a product of two curves. Thread-safe.
#pragma once

#include "protocol/base/text/name_table.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::curve {

enum class CurveAngle : std::uint8_t {
    half,
    difference,
    incidence,
    viewing,
    reflection,
    along_u,
    along_v,
};

inline constexpr text::NameTable<CurveAngle, 7> kCurveAngleNames({{
    {CurveAngle::half, "half"},
    {CurveAngle::difference, "difference"},
    {CurveAngle::incidence, "incidence"},
    {CurveAngle::viewing, "viewing"},
    {CurveAngle::reflection, "reflection"},
    {CurveAngle::along_u, "along_u"},
    {CurveAngle::along_v, "along_v"},
}});

// What people call the curve over each angle. A BRDF has at most one curve over an angle.
inline constexpr text::NameTable<CurveAngle, 7> kCurveNames({{
    {CurveAngle::half, "distribution"},
    {CurveAngle::difference, "fresnel"},
    {CurveAngle::incidence, "incidence"},
    {CurveAngle::viewing, "viewing"},
    {CurveAngle::reflection, "lobe"},
    {CurveAngle::along_u, "spread_u"},
    {CurveAngle::along_v, "spread_v"},
}});

// In [0, 1]; to 1e-6 of itself for the angles that are not along_u or along_v.
[[nodiscard]] float u_from_directions(CurveAngle angle,
                                      const Imath::V3f& wi,
                                      const Imath::V3f& wo);

// u in [0, 1], degrees in [0, 90]; each is the other's inverse.
[[nodiscard]] double degrees_from_u(CurveAngle angle, double u);
[[nodiscard]] double u_from_degrees(CurveAngle angle, double degrees);
// Whether u is √(θ/90°), not θ/90°.
[[nodiscard]] bool has_root_mapping(CurveAngle angle);

}  // namespace relume::curve
