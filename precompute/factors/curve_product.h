// One colour's product of curves while it is fitted: distribution, fresnel, and one curve for
// both incidence and viewing, 256 samples each.
#pragma once

#include "precompute/factors/curve_fit_samples.h"
#include "protocol/curve/curve.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace relume::factors {

inline constexpr Eigen::Index kFittedCurves = 3;
inline constexpr auto kCurveSize = static_cast<Eigen::Index>(curve::kCurveSamples);

// Column 0 distribution, 1 fresnel, 2 incidence and viewing.
using CurveColumns = Eigen::Matrix<double, kCurveSize, kFittedCurves>;

// Which column each of a sample's four places belongs to.
inline constexpr std::array<Eigen::Index, 4> kColumnOfPlace{0, 1, 2, 2};

[[nodiscard]] inline double value_at(const CurveColumns& columns,
                                     Eigen::Index column,
                                     const curve::CurvePlace& place) {
    const auto fraction = static_cast<double>(place.fraction);
    const auto k = static_cast<Eigen::Index>(place.sample);
    return (1 - fraction) * columns(k, column) + fraction * columns(k + 1, column);
}

// The four factors of the product.
[[nodiscard]] inline std::array<double, 4> factors_at(const CurveColumns& columns,
                                                      const CurveFitSample& sample) {
    std::array<double, 4> factors{};
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i] = value_at(columns, kColumnOfPlace[i], sample.places[i]);
    }
    return factors;
}

// The best product in the logarithm for what the samples reflect beyond `diffuse`.
[[nodiscard]] CurveColumns homomorphic_columns(const CurveFitSamples& samples,
                                               int colour,
                                               double diffuse);
// Improves `columns` in the cosine-weighted L2 norm.
void improve_nonnegative(const CurveFitSamples& samples,
                         int colour,
                         double diffuse,
                         CurveColumns& columns);

}  // namespace relume::factors
