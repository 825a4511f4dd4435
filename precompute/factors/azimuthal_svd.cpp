#include "precompute/factors/azimuthal_svd.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::factors {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLeastSingularValue = 1e-7;  // of the largest

// ∫ c² dφ.
double azimuthal_square(std::uint32_t frequency) {
    return frequency == 0 ? 2 * kPi : kPi;
}

Eigen::Map<const Eigen::VectorXd> weights_of(const PolarGrid& grid) {
    return {grid.weights.data(), static_cast<Eigen::Index>(grid.weights.size())};
}

// The largest absolute value is positive, so that one BRDF has one decomposition.
Eigen::VectorXd with_sign(const Eigen::VectorXd& vector) {
    Eigen::Index at = 0;
    vector.cwiseAbs().maxCoeff(&at);
    return vector[at] < 0 ? Eigen::VectorXd(-vector) : vector;
}

AzimuthalTerm term_of(const AzimuthalSpectrum& spectrum,
                      std::uint32_t frequency,
                      double singular_value,
                      const Eigen::VectorXd& right) {
    const Eigen::VectorXd scales =
        (weights_of(spectrum.grid()) * azimuthal_square(frequency)).cwiseSqrt().cwiseInverse();
    AzimuthalTerm term{frequency, false, singular_value, scales.cwiseProduct(right),
                       Eigen::MatrixXd(right.size(), spectrum.lobes())};
    for (std::size_t lobe = 0; lobe < spectrum.lobes(); ++lobe) {
        term.h.col(static_cast<Eigen::Index>(lobe)) =
            scales.cwiseProduct(spectrum.matrix(lobe, frequency).transpose() * right);
    }
    return term;
}

// From the eigenvectors of AᵀA, A stacked: they are as exact as tables of floats can use.
void append_terms_of(const AzimuthalSpectrum& spectrum,
                     std::uint32_t frequency,
                     const Eigen::MatrixXd& square,
                     std::size_t most_terms,
                     std::vector<AzimuthalTerm>& terms) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(square);
    const Eigen::Index count = square.rows();
    const Eigen::Index most = std::min(count, static_cast<Eigen::Index>(most_terms));
    for (Eigen::Index i = 0; i < most; ++i) {
        const double eigenvalue = solver.eigenvalues()[count - 1 - i];  // ascending
        if (eigenvalue <= 0 && !terms.empty()) {
            break;
        }
        terms.push_back(term_of(spectrum, frequency, std::sqrt(std::max(0.0, eigenvalue)),
                                with_sign(solver.eigenvectors().col(count - 1 - i))));
        if (frequency > 0) {
            terms.push_back(terms.back());
            terms.back().is_sine = true;
        }
    }
}

void keep_largest(std::vector<AzimuthalTerm>& terms, std::size_t most_terms) {
    std::stable_sort(terms.begin(), terms.end(),
                     [](const AzimuthalTerm& a, const AzimuthalTerm& b) {
                         return a.singular_value > b.singular_value;
                     });
    terms.resize(std::min(terms.size(), most_terms));
}

}  // namespace

std::vector<AzimuthalTerm> azimuthal_svd(const AzimuthalSpectrum& spectrum,
                                         std::span<const double> lobe_weights,
                                         std::size_t most_terms) {
    std::vector<AzimuthalTerm> terms;
    const auto rows = static_cast<Eigen::Index>(spectrum.grid().rows());
    for (std::uint32_t m = 0; m < spectrum.frequencies(); ++m) {
        Eigen::MatrixXd square = Eigen::MatrixXd::Zero(rows, rows);
        for (std::size_t lobe = 0; lobe < spectrum.lobes(); ++lobe) {
            const Eigen::MatrixXd weighted = lobe_weights[lobe] * spectrum.matrix(lobe, m);
            square.selfadjointView<Eigen::Lower>().rankUpdate(weighted);
        }
        // The trace bounds the square of the largest singular value.
        if (terms.size() == most_terms &&
            square.trace() <= terms.back().singular_value * terms.back().singular_value) {
            continue;
        }
        append_terms_of(spectrum, m, square, most_terms, terms);
        keep_largest(terms, most_terms);
    }
    while (!terms.empty() &&
           terms.back().singular_value < kLeastSingularValue * terms.front().singular_value) {
        terms.pop_back();
    }
    return terms;
}

Eigen::MatrixXd products_of(const AzimuthalTerm& term, const PolarGrid& grid) {
    return azimuthal_square(term.frequency) * term.h.transpose() *
           weights_of(grid).asDiagonal() * term.h;
}

}  // namespace relume::factors
