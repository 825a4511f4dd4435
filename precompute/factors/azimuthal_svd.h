// The best approximation of lobes by a sum of products [Wang04, Liu04], frequency by frequency:
// the singular value decomposition of each matrix of an azimuthal spectrum, the rows of all
// lobes stacked, each lobe times its weight. A frequency m ≥ 1 gives *pairs* of one singular
// value, cos mφo cos mφi and sin mφo sin mφi, whose sum depends on φo − φi alone.
#pragma once

#include "precompute/factors/azimuthal_spectrum.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::factors {

// g(ωi) = g(θi)·c(φi) and h_l(ωo) = h_l(θo)·c(φo), with c = cos mφ or sin mφ; values at the
// grid's angles.
struct AzimuthalTerm {
    std::uint32_t frequency = 0;  // m
    bool is_sine = false;
    double singular_value = 0;
    Eigen::VectorXd g;  // of norm 1 under dμ
    Eigen::MatrixXd h;  // a column a lobe: the lobe's operator applied to g
};

// The terms of the largest singular values, at most so many, descending; a cosine before its
// sine, which follows at once. Terms whose singular value is below 1e-7 of the largest are left
// out; there is at least one. Weights are not negative, one a lobe.
[[nodiscard]] std::vector<AzimuthalTerm> azimuthal_svd(const AzimuthalSpectrum& spectrum,
                                                       std::span<const double> lobe_weights,
                                                       std::size_t most_terms);

// ∫ h_l h_l' dμ of one term: what it takes off the products of the lobes.
[[nodiscard]] Eigen::MatrixXd products_of(const AzimuthalTerm& term, const PolarGrid& grid);

}  // namespace relume::factors
