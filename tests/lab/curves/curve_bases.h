// The same change of a curve in a few terms of different bases.
#pragma once

#include "tests/lab/curves/curve_gram.h"

#include <cstdint>
#include <string_view>

namespace relume::lab {

// daubechies4 and haar take the terms whose columns change the image most, whatever the
// curve; splines are the best uniform cubic B-spline of so many control points.
enum class CurveTerms : std::uint8_t { daubechies4, haar, splines };

inline constexpr std::array<CurveTerms, 3> kCurveTerms{CurveTerms::daubechies4,
                                                       CurveTerms::haar, CurveTerms::splines};

[[nodiscard]] std::string_view name_of(CurveTerms terms);

// ‖T'(δ − δ̃)‖ / ‖T' δ‖ with δ̃ of so many terms, 4 … 256.
[[nodiscard]] double error_of_terms(const CurveGram& gram,
                                    const std::array<Eigen::VectorXd, 3>& change,
                                    CurveTerms basis,
                                    std::uint32_t terms);

}  // namespace relume::lab
