// What is left off where measured BRDFs become products of curves.
#pragma once

#include "precompute/factors/curve_factors.h"

#include <string_view>
#include <vector>

namespace relume::lab {

struct MeasuredCurves {
    std::string_view material;
    factors::CurveMethod method = factors::CurveMethod::homomorphic;
    factors::CurveErrors errors;
};

// Of three published fits of the MERL database (tests/support/published_fits.h), written in its
// layout and read as a bake reads it, by both methods. Seconds.
[[nodiscard]] std::vector<MeasuredCurves> measured_curves();

}  // namespace relume::lab
