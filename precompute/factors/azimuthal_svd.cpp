#include "precompute/factors/azimuthal_svd.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::factors {
namespace {

constexpr double kLeastSingularValue = 1e-7;  // of the largest

// The lobes at one frequency.
class FrequencyLobes {
  public:
    FrequencyLobes(const AzimuthalSpectrum& spectrum,
                   const LightWaves& light,
                   std::span<const double> weights,
                   std::uint32_t m)
        : spectrum_(spectrum), weights_(weights), m_(m) {
        for (std::size_t lobe = 0; lobe < weights.size(); ++lobe) {
            reflected_.push_back(light.reflected(m, spectrum.matrix(lobe, m)));
        }
    }

    // Of what is reflected, all lobes stacked, with its transpose: its eigenvalues are the
    // squares of the singular values, as exact as tables of floats can use.
    [[nodiscard]] Eigen::MatrixXd square() const {
        const Eigen::Index waves = reflected_.front().rows();
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(waves, waves);
        for (std::size_t lobe = 0; lobe < weights_.size(); ++lobe) {
            const Eigen::MatrixXd weighted = weights_[lobe] * reflected_[lobe];
            sum.selfadjointView<Eigen::Lower>().rankUpdate(weighted);
        }
        return sum;
    }

    [[nodiscard]] AzimuthalTerm term(double singular_value, const Eigen::VectorXd& wave) const {
        const std::vector<double>& grid_weights = spectrum_.grid().weights;
        const auto rows = static_cast<Eigen::Index>(grid_weights.size());
        Eigen::MatrixXd h(rows, weights_.size());
        Eigen::VectorXd g = Eigen::VectorXd::Zero(rows);
        for (std::size_t lobe = 0; lobe < weights_.size(); ++lobe) {
            const auto column = static_cast<Eigen::Index>(lobe);
            h.col(column) = reflected_[lobe].transpose() * wave;
            if (singular_value > 0) {
                h.col(column) /= singular_value;
            }
            g += weights_[lobe] * weights_[lobe] * (spectrum_.matrix(lobe, m_) * h.col(column));
        }
        // One BRDF has one decomposition.
        Eigen::Index largest = 0;
        g.cwiseAbs().maxCoeff(&largest);
        const double sign = g[largest] < 0 ? -1 : 1;
        // From coordinates to values.
        const Eigen::VectorXd scales =
            sign * (Eigen::Map<const Eigen::VectorXd>(grid_weights.data(), rows) *
                    azimuthal_square(m_))
                       .cwiseSqrt()
                       .cwiseInverse();
        return {m_, false, singular_value, scales.cwiseProduct(g), scales.asDiagonal() * h};
    }

  private:
    const AzimuthalSpectrum& spectrum_;
    std::span<const double> weights_;
    std::uint32_t m_;
    std::vector<Eigen::MatrixXd> reflected_;
};

void append_terms(const FrequencyLobes& lobes,
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
        terms.push_back(lobes.term(std::sqrt(std::max(0.0, eigenvalue)),
                                   solver.eigenvectors().col(count - 1 - i)));
        if (terms.back().frequency > 0) {
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

double azimuthal_square(std::uint32_t frequency) {
    return frequency == 0 ? 2 * std::numbers::pi : std::numbers::pi;
}

std::vector<AzimuthalTerm> azimuthal_svd(const AzimuthalSpectrum& spectrum,
                                         const LightWaves& light,
                                         std::span<const double> lobe_weights,
                                         std::size_t most_terms) {
    std::vector<AzimuthalTerm> terms;
    for (std::uint32_t m = 0; m < spectrum.frequencies(); ++m) {
        const FrequencyLobes lobes(spectrum, light, lobe_weights, m);
        const Eigen::MatrixXd square = lobes.square();
        // The trace bounds the square of the largest singular value.
        if (terms.size() == most_terms &&
            square.trace() <= terms.back().singular_value * terms.back().singular_value) {
            continue;
        }
        append_terms(lobes, square, most_terms, terms);
        keep_largest(terms, most_terms);
    }
    while (terms.back().singular_value < kLeastSingularValue * terms.front().singular_value) {
        terms.pop_back();
    }
    return terms;
}

}  // namespace relume::factors
