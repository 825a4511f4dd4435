// The best approximation of lobes by a sum of products [Wang04, Liu04], frequency by frequency:
// the singular value decomposition of what the lobes make of the light of one frequency, all
// lobes stacked, each times its weight. A frequency m ≥ 1 gives *pairs* of one singular value,
// cos mφo cos mφi and sin mφo sin mφi, whose sum depends on φo − φi alone.
//
// The sum's functions of the view are the left singular vectors h, and those of the light are
// what the lobes' transposes make of them: g = Σ_l w_l² f_lᵀ h_l. No other sum of as many
// products leaves less of the reflected light.
#pragma once

#include "precompute/factors/azimuthal_spectrum.h"
#include "precompute/factors/light_waves.h"

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
    Eigen::VectorXd g;
    Eigen::MatrixXd h;  // a column a lobe; Σ_l w_l² ∫ h_l² dμ = 1
};

// ∫ c² dφ.
[[nodiscard]] double azimuthal_square(std::uint32_t frequency);

// The terms of the largest singular values, at most so many, descending; a cosine before its
// sine, which follows at once. Terms whose singular value is below 1e-7 of the largest are left
// out; there is at least one. Weights are not negative, one a lobe.
[[nodiscard]] std::vector<AzimuthalTerm> azimuthal_svd(const AzimuthalSpectrum& spectrum,
                                                       const LightWaves& light,
                                                       std::span<const double> lobe_weights,
                                                       std::size_t most_terms);

}  // namespace relume::factors
