// A specular BRDF as a product of curves [BenArtzi06],
//
//     f(ωi, ωo)[rgb] = rest(ωi, ωo) · Π_c curve_c(u_c(ωi, ωo))[rgb]   in 1/sr, without cosine.
//
// `rest` is what no curve holds. Directions are unit vectors in the local frame
// (curve_angle.h); with c_i, c_o their cosines to the normal and c_d that of θ_d:
//
// - ggx(f0, f90, α): `distribution` ggx(α), `fresnel` schlick(f0, f90),
//   rest = G/(4 c_i c_o) with Smith's height-correlated G of α [Heitz14]:
//   ½/(c_i √(c_o²(1−α²) + α²) + c_o √(c_i²(1−α²) + α²)).
//   An edited distribution leaves G as it is.
// - cook_torrance(σ, n, e): `distribution` beckmann(σ), `fresnel` conductor(n, e),
//   rest = G/(4 c_i c_o), G = min(1, 2 c_h c_o/c_d, 2 c_h c_i/c_d) [CookTorrance82]. The
//   distribution holds 1/π, so that f is F G D/(4 c_i c_o): with D without 1/π the same is
//   F G D/(4π c_i c_o) [Overbeck06T eq. 3.10].
// - ashikhmin_shirley(rs, n_u, n_v): `spread_u`, `spread_v` cosine_power, `fresnel`
//   schlick(rs, 1), rest = 1/(8π c_d max(c_i, c_o)) [AshikhminShirley00].
// - phong(ks, exponent): `lobe` cosine_power tinted by ks [Lafortune94], rest = 1.
// - measured(curves): any curves, rest = 1.
//
// Cosines in `rest` below 1e-4 count as 1e-4, so that it is at most 5·10⁷ everywhere, and f is
// finite in single precision whatever its curves are. f is 0 unless both directions lie above
// the horizon, z > 0. It is reciprocal where the curves `incidence` and `viewing` are both
// absent or the same. const members are thread-safe.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/curve/curve.h"
#include "protocol/curve/curve_angle.h"
#include "protocol/curve/parameter.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace relume::curve {

enum class CurveModel : std::uint8_t {
    ggx,
    cook_torrance,
    ashikhmin_shirley,
    phong,
    measured,
};

inline constexpr text::NameTable<CurveModel, 5> kCurveModelNames({{
    {CurveModel::ggx, "ggx"},
    {CurveModel::cook_torrance, "cook_torrance"},
    {CurveModel::ashikhmin_shirley, "ashikhmin_shirley"},
    {CurveModel::phong, "phong"},
    {CurveModel::measured, "measured"},
}});

// None for `measured`.
[[nodiscard]] std::span<const Parameter> parameters_of(CurveModel model);

struct BrdfCurve {
    CurveAngle angle = CurveAngle::half;
    Curve curve;

    // What people call it.
    [[nodiscard]] std::string_view name() const { return kCurveNames.name(angle); }
    friend bool operator==(const BrdfCurve&, const BrdfCurve&) = default;
};

class CurveBrdf {
  public:
    // Their product is finite in single precision.
    static constexpr std::size_t kMostMeasuredCurves = 6;

    // Each throws CurveError for a parameter out of range.
    [[nodiscard]] static CurveBrdf ggx(const Imath::V3f& f0, float f90, float alpha);
    [[nodiscard]] static CurveBrdf cook_torrance(float sigma,
                                                 const Imath::V3f& n,
                                                 const Imath::V3f& e);
    [[nodiscard]] static CurveBrdf ashikhmin_shirley(const Imath::V3f& rs, float nu, float nv);
    [[nodiscard]] static CurveBrdf phong(const Imath::V3f& ks, float exponent);
    // One to kMostMeasuredCurves valid curves over different angles, which come to
    // stand in the order of the angles; CurveError else.
    [[nodiscard]] static CurveBrdf measured(std::vector<BrdfCurve> curves);
    // Of every model but `measured`; values as parameters_of(model).
    [[nodiscard]] static CurveBrdf from_parameters(CurveModel model, ParameterValues values);

    [[nodiscard]] CurveModel model() const { return model_; }
    [[nodiscard]] const ParameterValues& parameters() const { return parameters_; }
    [[nodiscard]] std::span<const BrdfCurve> curves() const { return curves_; }
    [[nodiscard]] std::optional<std::size_t> index_of(CurveAngle angle) const;
    // Throws CurveError that names the curves there are.
    [[nodiscard]] std::size_t index_of(std::string_view curve_name) const;

    // The same BRDF with one curve replaced; CurveError for one that is not valid.
    [[nodiscard]] CurveBrdf with_curve(std::size_t index, const Curve& curve) const;
    // Whether a curve is that of the parameters; false for all of `measured`.
    [[nodiscard]] bool is_of_parameters(std::size_t index) const;

    [[nodiscard]] Imath::V3f evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const;
    // f without the factor of one curve: f = quotient(i, ωi, ωo)·curves()[i].curve.at(u_i).
    [[nodiscard]] Imath::V3f quotient(std::size_t index,
                                      const Imath::V3f& wi,
                                      const Imath::V3f& wo) const;
    // The factor that no curve holds, 0 below the horizon.
    [[nodiscard]] float rest(const Imath::V3f& wi, const Imath::V3f& wo) const;

    friend bool operator==(const CurveBrdf&, const CurveBrdf&) = default;

  private:
    CurveBrdf() = default;
    // The product of all curves but the one of index `without`.
    [[nodiscard]] Imath::V3f product(std::size_t without,
                                     const Imath::V3f& wi,
                                     const Imath::V3f& wo) const;

    CurveModel model_ = CurveModel::measured;
    ParameterValues parameters_;
    std::vector<BrdfCurve> curves_;
    std::vector<bool> is_replaced_;  // one a curve
};

}  // namespace relume::curve
