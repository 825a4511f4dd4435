#include "precompute/factors/azimuthal_spectrum.h"

#include <boost/math/quadrature/gauss.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::factors {
namespace {

constexpr double kPi = std::numbers::pi;

// Points in (0, π) and weights for integrals over it. With Δ = π(1 − u³) the points are uniform
// in u, so that they crowd at the mirror direction Δ = π, where a highlight at grazing angles
// is far narrower than elsewhere.
struct AzimuthRule {
    std::vector<double> points;
    std::vector<double> weights;

    explicit AzimuthRule(std::uint32_t frequencies) {
        constexpr unsigned kPointsPerCell = 4;
        constexpr std::uint32_t kLeastCells = 96;
        using Gauss = boost::math::quadrature::gauss<double, kPointsPerCell>;
        const std::uint32_t cells = std::max(kLeastCells, 3 * frequencies);
        for (std::uint32_t cell = 0; cell < cells; ++cell) {
            for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
                for (const double side : {-1.0, 1.0}) {
                    const double u = (cell + 0.5 + 0.5 * side * Gauss::abscissa()[i]) / cells;
                    points.push_back(kPi * (1 - u * u * u));
                    weights.push_back(0.5 * Gauss::weights()[i] / cells * 3 * kPi * u * u);
                }
            }
        }
    }
};

// All (θi, Δ), Δ running fastest.
struct DirectionsToLight {
    std::vector<float> x, y, z;

    DirectionsToLight(const PolarGrid& grid, const AzimuthRule& rule) {
        for (const double theta : grid.thetas) {
            for (const double delta : rule.points) {
                x.push_back(static_cast<float>(std::sin(theta) * std::cos(delta)));
                y.push_back(static_cast<float>(std::sin(theta) * std::sin(delta)));
                z.push_back(static_cast<float>(std::cos(theta)));
            }
        }
    }
    [[nodiscard]] brdf::Directions planes() const { return {x, y, z}; }
};

// From values at the rule's points to 2 ∫ f cos mΔ dΔ over (0, π), which is 2π·a_m.
Eigen::MatrixXd cosine_transform(const AzimuthRule& rule, std::uint32_t frequencies) {
    Eigen::MatrixXd transform(frequencies, rule.points.size());
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
        for (std::uint32_t m = 0; m < frequencies; ++m) {
            transform(m, static_cast<Eigen::Index>(q)) =
                2 * rule.weights[q] * std::cos(m * rule.points[q]);
        }
    }
    return transform;
}

}  // namespace

AzimuthalSpectrum::AzimuthalSpectrum(const BrdfLobes& lobes,
                                     std::uint32_t rows,
                                     std::uint32_t frequencies)
    : grid_(rows),
      lobes_(lobes.count()),
      frequencies_(frequencies),
      matrices_(lobes_ * frequencies, Eigen::MatrixXd(rows, rows)) {
    const AzimuthRule rule(frequencies);
    const DirectionsToLight to_light(grid_, rule);
    const Eigen::MatrixXd transform = cosine_transform(rule, frequencies);
    const Eigen::Map<const Eigen::VectorXd> rule_weights(
        rule.weights.data(), static_cast<Eigen::Index>(rule.weights.size()));
    const auto in_row = static_cast<Eigen::Index>(rule.points.size());
    const auto count = static_cast<Eigen::Index>(lobes_);
    const Eigen::Map<const Eigen::VectorXd> weights(grid_.weights.data(), rows);
    const Eigen::VectorXd roots = weights.cwiseSqrt();
    // One for each θo, added in order: the sums are the same whatever the threads do.
    std::vector<Eigen::MatrixXd> row_products(rows, Eigen::MatrixXd::Zero(count, count));

    tbb::parallel_for(0U, rows, [&](std::uint32_t o) {
        const double theta = grid_.thetas[o];
        std::vector<float> sampled(lobes_ * to_light.x.size());
        lobes.evaluate(
            {static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta))},
            to_light.planes(), sampled);
        std::vector<Eigen::MatrixXd> values;
        for (std::size_t lobe = 0; lobe < lobes_; ++lobe) {
            values.emplace_back(Eigen::Map<const Eigen::MatrixXf>(
                                    &sampled[lobe * to_light.x.size()], in_row, rows)
                                    .cast<double>());
            const Eigen::MatrixXd spectrum = transform * values.back();
            for (std::uint32_t m = 0; m < frequencies_; ++m) {
                matrices_[lobe * frequencies_ + m].col(o) =
                    roots[o] * roots.cwiseProduct(spectrum.row(m).transpose());
            }
        }
        for (Eigen::Index a = 0; a < count; ++a) {
            for (Eigen::Index b = 0; b < count; ++b) {
                const auto product = values[static_cast<std::size_t>(a)].cwiseProduct(
                    values[static_cast<std::size_t>(b)]);
                row_products[o](a, b) =
                    4 * kPi * weights[o] * rule_weights.dot(product * weights);
            }
        }
    });
    products_ = Eigen::MatrixXd::Zero(count, count);
    for (const Eigen::MatrixXd& of_row : row_products) {
        products_ += of_row;
    }
}

double square_in_colour(const std::vector<Imath::V3f>& colours,
                        const Eigen::MatrixXd& products) {
    double sum = 0;
    for (std::size_t a = 0; a < colours.size(); ++a) {
        for (std::size_t b = 0; b < colours.size(); ++b) {
            sum += Imath::V3d(colours[a]).dot(Imath::V3d(colours[b])) *
                   products(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        }
    }
    return sum;
}

}  // namespace relume::factors
