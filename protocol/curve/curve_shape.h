// Curves that a few parameters make: the factors of analytic BRDFs. Each is evaluated in double
// at the angle θ of every sample, rounded to single precision.
//
// - `beckmann`: σ, the root mean square slope, 0.001 … 2:
//   exp(−tan²θ/σ²)/(π σ² cos⁴θ) [CookTorrance82]
// - `ggx`: α 0.001 … 1: α²/(π (α² cos²θ + sin²θ)²) [Walter07]
// - `velvet`: σ 0.05 … 2: (1 + 4 exp(−cot²θ/σ²)/sin⁴θ)/(π (1 + 4σ²)) [Ashikhmin07]
// - `conductor`: n 0.01 … 10, e 0 … 20, in red, green, blue: Fresnel's reflectance of a complex
//   index n + ie, without polarisation
// - `dielectric`: n 1 … 4: the same without extinction
// - `schlick`: f0 in red, green, blue, f90: f0 + (f90 − f0)(1 − cos θ)⁵ [Schlick94]
// - `cosine_power`: exponent p 0 … 1e5: N·cosᵖθ, N = (p+2)/2π over `half` and `reflection`
//   (normalised as a distribution of normals, and as Phong's lobe [Lafortune94]), √(p+1) over
//   `along_u` and `along_v` [AshikhminShirley00], 1 over the other angles
// - `constant`: value in red, green, blue
//
// The first three are distributions D of normals, ∫ D cos θ dω = 1. Pure; thread-safe.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/curve/curve.h"
#include "protocol/curve/curve_angle.h"
#include "protocol/curve/parameter.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace relume::curve {

enum class CurveShape : std::uint8_t {
    beckmann,
    ggx,
    velvet,
    conductor,
    dielectric,
    schlick,
    cosine_power,
    constant,
};

inline constexpr text::NameTable<CurveShape, 8> kCurveShapeNames({{
    {CurveShape::beckmann, "beckmann"},
    {CurveShape::ggx, "ggx"},
    {CurveShape::velvet, "velvet"},
    {CurveShape::conductor, "conductor"},
    {CurveShape::dielectric, "dielectric"},
    {CurveShape::schlick, "schlick"},
    {CurveShape::cosine_power, "cosine_power"},
    {CurveShape::constant, "constant"},
}});

[[nodiscard]] std::span<const Parameter> parameters_of(CurveShape shape);
// Throws CurveError that names the shapes that are near.
[[nodiscard]] CurveShape shape_from_name(std::string_view name);

struct ShapedCurve {
    CurveShape shape = CurveShape::constant;
    ParameterValues values;  // as parameters_of(shape)

    // Throws CurveError for a value out of range.
    [[nodiscard]] Curve curve(CurveAngle angle) const;
    friend bool operator==(const ShapedCurve&, const ShapedCurve&) = default;
};

// Throws CurveError for a value out of range.
[[nodiscard]] Curve curve_from_shape(CurveShape shape,
                                     CurveAngle angle,
                                     std::span<const Imath::V3d> values);

// Reflectance of a smooth surface of index n + ie for unpolarised light, cosine in [0, 1].
[[nodiscard]] double fresnel_reflectance(double cosine, double n, double e);

}  // namespace relume::curve
