#include "precompute/factors/nonnegative_factors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::factors {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostSweeps = 60;
constexpr double kLeastGain = 1e-4;  // of the error's square, a sweep; below it a fit ends

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Functions on the grid as coordinates in which inner products are those of dμ, and the lobes'
// operators on them.
class GridOperator {
  public:
    GridOperator(const AzimuthalSpectrum& spectrum, std::uint32_t columns)
        : spectrum_(spectrum),
          rows_(spectrum.grid().rows()),
          columns_(columns),
          basis_(columns, 2 * spectrum.frequencies() - 1),
          roots_(rows_ * columns_) {
        const double step = 2 * kPi / columns;
        for (Index j = 0; j < columns_; ++j) {
            basis_(j, 0) = std::sqrt(1.0 / columns);
            for (Index m = 1; m < spectrum.frequencies(); ++m) {
                const double angle = static_cast<double>(m * j) * step;
                basis_(j, 2 * m - 1) = std::sqrt(2.0 / columns) * std::cos(angle);
                basis_(j, 2 * m) = std::sqrt(2.0 / columns) * std::sin(angle);
            }
            for (Index i = 0; i < rows_; ++i) {
                roots_[j * rows_ + i] =
                    std::sqrt(spectrum.grid().weights[static_cast<std::size_t>(i)] * step);
            }
        }
    }

    [[nodiscard]] Index size() const { return roots_.size(); }
    // √ of a direction's part of the measure: coordinate = value × root.
    [[nodiscard]] const VectorXd& roots() const { return roots_; }

    // f: functions of the light to functions of the view, column by column.
    [[nodiscard]] MatrixXd apply(std::size_t lobe, const MatrixXd& to_light) const {
        return mapped(lobe, to_light, true);
    }
    // fᵀ: the other way.
    [[nodiscard]] MatrixXd apply_transposed(std::size_t lobe, const MatrixXd& to_view) const {
        return mapped(lobe, to_view, false);
    }

  private:
    [[nodiscard]] MatrixXd mapped(std::size_t lobe, const MatrixXd& of, bool to_view) const {
        const Index terms = of.cols();
        std::vector<MatrixXd> waves;  // a matrix of rows × waves for each term
        for (Index k = 0; k < terms; ++k) {
            waves.emplace_back(Eigen::Map<const MatrixXd>(of.col(k).data(), rows_, columns_) *
                               basis_);
        }
        for (std::uint32_t m = 0; m < spectrum_.frequencies(); ++m) {
            const Index first = m == 0 ? 0 : 2 * static_cast<Index>(m) - 1;
            const Index width = m == 0 ? 1 : 2;
            MatrixXd together(rows_, width * terms);
            for (Index k = 0; k < terms; ++k) {
                together.middleCols(k * width, width) =
                    waves[static_cast<std::size_t>(k)].middleCols(first, width);
            }
            const MatrixXd& matrix = spectrum_.matrix(lobe, m);
            const MatrixXd result =
                to_view ? MatrixXd(matrix.transpose() * together) : MatrixXd(matrix * together);
            for (Index k = 0; k < terms; ++k) {
                waves[static_cast<std::size_t>(k)].middleCols(first, width) =
                    result.middleCols(k * width, width);
            }
        }
        MatrixXd out(size(), terms);
        for (Index k = 0; k < terms; ++k) {
            Eigen::Map<MatrixXd>(out.col(k).data(), rows_, columns_) =
                waves[static_cast<std::size_t>(k)] * basis_.transpose();
        }
        return out;
    }

    const AzimuthalSpectrum& spectrum_;
    Index rows_;
    Index columns_;
    MatrixXd basis_;  // columns × waves, orthonormal
    VectorXd roots_;
};

// factor_k ← max(0, the best for the others as they are), k by k. `target` is the operator
// applied to the other side, `square` that side's inner products.
void improve(const MatrixXd& target, const MatrixXd& square, MatrixXd& factor) {
    for (Index k = 0; k < factor.cols(); ++k) {
        if (square(k, k) > 0) {
            factor.col(k) += (target.col(k) - factor * square.col(k)) / square(k, k);
            factor.col(k) = factor.col(k).cwiseMax(0.0);
        }
    }
}

// A power of the cosine around one of a spiral of axes: where term k begins.
VectorXd broad_lobe(const PolarGrid& grid, std::uint32_t columns, std::size_t k) {
    constexpr double kGoldenAngle = 2.399963229728653;
    constexpr double kExponent = 4;
    const double height = 1 - (static_cast<double>(k % 10) + 0.5) / 10;
    const double azimuth = static_cast<double>(k) * kGoldenAngle;
    VectorXd lobe(static_cast<Index>(grid.rows() * columns));
    for (std::uint32_t j = 0; j < columns; ++j) {
        for (std::uint32_t i = 0; i < grid.rows(); ++i) {
            const double cosine = height * std::cos(grid.thetas[i]) +
                                  std::sqrt(1 - height * height) * std::sin(grid.thetas[i]) *
                                      std::cos(2 * kPi * j / columns - azimuth);
            lobe[static_cast<Index>(j * grid.rows() + i)] =
                std::pow(std::max(0.0, cosine), kExponent);
        }
    }
    return lobe;
}

// The fit as it stands: coordinates, lobes times their weights.
class Fit {
  public:
    Fit(const AzimuthalSpectrum& spectrum,
        std::span<const double> lobe_weights,
        std::uint32_t columns)
        : spectrum_(spectrum),
          weights_(lobe_weights.begin(), lobe_weights.end()),
          columns_(columns),
          operator_(spectrum, columns),
          g_(operator_.size(), 0),
          h_(weights_.size(), MatrixXd(operator_.size(), 0)) {}

    void add_term() {
        const Index terms = g_.cols();
        g_.conservativeResize(Eigen::NoChange, terms + 1);
        g_.col(terms) = operator_.roots().cwiseProduct(
            broad_lobe(spectrum_.grid(), columns_, static_cast<std::size_t>(terms)));
        for (MatrixXd& h : h_) {
            h.conservativeResize(Eigen::NoChange, terms + 1);
            h.col(terms).setZero();
        }
    }

    void improve_until_still() {
        double whole = 0;
        for (std::size_t lobe = 0; lobe < weights_.size(); ++lobe) {
            const auto l = static_cast<Index>(lobe);
            whole += weights_[lobe] * weights_[lobe] * spectrum_.products()(l, l);
        }
        double before = whole;
        for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
            const double after = whole - sweep_once();
            if (sweep > 0 && before - after <= kLeastGain * before) {
                break;
            }
            before = after;
        }
    }

    [[nodiscard]] NonnegativeFactors result() const {
        NonnegativeFactors factors;
        const VectorXd inverse_roots = operator_.roots().cwiseInverse();
        factors.g = inverse_roots.asDiagonal() * g_;
        const auto count = static_cast<Index>(weights_.size());
        factors.error_products = spectrum_.products();
        const MatrixXd square = g_.transpose() * g_;
        std::vector<MatrixXd> h;  // coordinates without the weights
        for (std::size_t lobe = 0; lobe < weights_.size(); ++lobe) {
            h.emplace_back(weights_[lobe] > 0 ? MatrixXd(h_[lobe] / weights_[lobe])
                                              : MatrixXd::Zero(g_.rows(), g_.cols()));
            factors.h.emplace_back(inverse_roots.asDiagonal() * h.back());
        }
        for (Index a = 0; a < count; ++a) {
            const MatrixXd applied = operator_.apply(static_cast<std::size_t>(a), g_);
            for (Index b = 0; b < count; ++b) {
                const MatrixXd& other = h[static_cast<std::size_t>(b)];
                const double mixed = applied.cwiseProduct(other).sum();
                factors.error_products(a, b) -= mixed;
                factors.error_products(b, a) -= mixed;
                factors.error_products(a, b) +=
                    (h[static_cast<std::size_t>(a)].transpose() * other)
                        .cwiseProduct(square)
                        .sum();
            }
        }
        return factors;
    }

  private:
    // Every factor once; returns what the sum of products takes off the lobes' square.
    double sweep_once() {
        const MatrixXd light_square = g_.transpose() * g_;
        MatrixXd view_square = MatrixXd::Zero(g_.cols(), g_.cols());
        MatrixXd target = MatrixXd::Zero(g_.rows(), g_.cols());
        for (std::size_t lobe = 0; lobe < weights_.size(); ++lobe) {
            improve(weights_[lobe] * operator_.apply(lobe, g_), light_square, h_[lobe]);
            view_square += h_[lobe].transpose() * h_[lobe];
            target += weights_[lobe] * operator_.apply_transposed(lobe, h_[lobe]);
        }
        improve(target, view_square, g_);
        return 2 * target.cwiseProduct(g_).sum() -
               (g_.transpose() * g_).cwiseProduct(view_square).sum();
    }

    const AzimuthalSpectrum& spectrum_;
    std::vector<double> weights_;
    std::uint32_t columns_;
    GridOperator operator_;
    MatrixXd g_;
    std::vector<MatrixXd> h_;
};

}  // namespace

std::vector<NonnegativeFactors> nonnegative_factors(const AzimuthalSpectrum& spectrum,
                                                    std::span<const double> lobe_weights,
                                                    std::uint32_t columns,
                                                    std::size_t most_terms) {
    Fit fit(spectrum, lobe_weights, columns);
    std::vector<NonnegativeFactors> all;
    for (std::size_t k = 0; k < most_terms; ++k) {
        fit.add_term();
        fit.improve_until_still();
        all.push_back(fit.result());
    }
    return all;
}

}  // namespace relume::factors
