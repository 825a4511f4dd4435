// Lobes as sums of products of functions that are nowhere negative [LeeSeung01]. No such sum
// errs less than the singular value decomposition, but none reflects less than nothing.
//
// The functions have values on the directions of a grid: the rows of a PolarGrid and columns of
// φ. The factors are improved one at a time (hierarchical alternating least squares
// [Cichocki07]), which never adds to the error. K terms begin from the K − 1 before them and a
// broad lobe of its own, so that the error falls with K.
#pragma once

#include "precompute/factors/azimuthal_spectrum.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::factors {

// K terms. Row column·rows + row of a matrix is a direction of the grid.
struct NonnegativeFactors {
    Eigen::MatrixXd g;               // directions × K
    std::vector<Eigen::MatrixXd> h;  // for each lobe, directions × K
    Eigen::MatrixXd error_products;  // ∬ e_l e_l' dμ dμ of the lobes' errors e
};

// Frequencies that a spectrum needs, so that functions on so many columns see all that they
// can.
[[nodiscard]] constexpr std::uint32_t frequencies_for_columns(std::uint32_t columns) {
    return columns / 2;
}

// For K = 1 … most_terms. The spectrum has frequencies_for_columns(columns). Lobes of weight 0
// get h = 0.
[[nodiscard]] std::vector<NonnegativeFactors> nonnegative_factors(
    const AzimuthalSpectrum& spectrum,
    std::span<const double> lobe_weights,
    std::uint32_t columns,
    std::size_t most_terms);

}  // namespace relume::factors
