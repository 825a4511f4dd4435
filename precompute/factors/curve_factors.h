// BRDFs as products of four curves that an artist edits [BenArtzi06],
//
//     ρ(ωi, ωo) ≈ diffuse/π + distribution(θ_h) · fresnel(θ_d) · incidence(θ_i) · viewing(θ_o),
//
// each colour by itself, with one curve for incidence and viewing, so that it is reciprocal.
// `diffuse` is nothing, or what all but a tenth, three tenths or half of the directions reflect
// at least, whichever leaves the least error. Two ways to find the product that is beyond it:
//
// - homomorphic [McCool01]: the logarithm of a product is a sum, linear in the logarithms of
//   the samples, and is fitted by weighted least squares with penalties on first and second
//   differences, which also fill in what no pair of directions reaches. The relative error is
//   small wherever it can be seen, in highlights and beside them.
// - non-negative [Lawrence04]: from there, the samples themselves are fitted by Lee and Seung's
//   updates of one curve after another [LeeSeung01], which keep them from being negative, as
//   long as they take off the error in the cosine-weighted L2 norm. Highlights weigh most.
//
// fresnel, incidence and viewing have the geometric mean 1 over the directions that a
// homomorphic fit looks at, and distribution holds the rest. A colour that is black everywhere
// has the distribution 0.
#pragma once

#include "precompute/factors/brdf_lobes.h"
#include "precompute/factors/merl_brdf.h"
#include "protocol/base/text/name_table.h"
#include "protocol/curve/curve_brdf.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>

namespace relume::factors {

enum class CurveMethod : std::uint8_t { homomorphic, nonnegative };

// As options and reports spell them.
inline constexpr text::NameTable<CurveMethod, 2> kCurveMethodNames({{
    {CurveMethod::homomorphic, "homomorphic"},
    {CurveMethod::nonnegative, "nmf"},
}});

// Directions are judged whose cosine is at least this: closer to the horizon nothing can be
// measured, and many formulas grow without bound.
inline constexpr float kLeastJudgedCosine = 0.01F;

// Of diffuse and product together, against the BRDF that was factored, in directions that the
// fit did not look at; all colours together.
struct CurveErrors {
    // √(∫ |ρ̂ − ρ|² dμ / ∫ |ρ|² dμ), dμ = cos θi dωi cos θo dωo.
    double relative_l2 = 0;
    // √ of the mean of ln²((ρ̂ + floor)/(ρ + floor)) under dμ, floor being 1e-4 of the mean of
    // ρ: 0.1 is 10 % off.
    double logarithmic = 0;
};

struct CurveFactorisation {
    Imath::V3f diffuse{0, 0, 0};  // an albedo: what diffuse/π reflects under white light
    curve::CurveBrdf brdf;        // CurveModel::measured
    CurveErrors errors;
    // Of the values that the fit looked at, in any colour: how many there were, how many were
    // negative and counted as 0, and how many lay below the floor of the logarithm, where they
    // hardly count.
    std::size_t value_count = 0;
    std::size_t negative_count = 0;
    std::size_t floored_count = 0;
    // Values of a measured file that were negative: nothing was measured there.
    std::size_t unmeasured_count = 0;
};

// Each throws FactorError for a BRDF that is black, or not finite somewhere. Deterministic;
// seconds, and 100 MiB.
[[nodiscard]] CurveFactorisation factorise_curves(const BrdfLobes& lobes, CurveMethod method);
[[nodiscard]] CurveFactorisation factorise_curves(const MerlBrdf& measured, CurveMethod method);

// Throws as they do.
[[nodiscard]] CurveErrors curve_errors(const Imath::V3f& diffuse,
                                       const curve::CurveBrdf& brdf,
                                       const BrdfLobes& lobes);

}  // namespace relume::factors
