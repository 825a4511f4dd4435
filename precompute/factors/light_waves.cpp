#include "precompute/factors/light_waves.h"

#include <cmath>
#include <numbers>

namespace relume::factors {
namespace {

constexpr std::uint32_t kMostDegree = 64;
// K ≤ 16 terms reach no higher: a frequency's largest singular value falls with the frequency.
constexpr std::uint32_t kUncorrelatedFrequencies = 17;

// Variance of each function of a degree; the sum over all but the constant's is the constant's.
double variance_of_degree(std::uint32_t degree) {
    static const double sum = [] {
        double total = 0;
        for (std::uint32_t l = 1; l <= kMostDegree; ++l) {
            total += (2.0 * l + 1) / (l * (l + 1.0));
        }
        return total;
    }();
    return degree == 0 ? 1.0 : 1 / (degree * (degree + 1.0) * sum);
}

}  // namespace

LightWaves::LightWaves(LightModel model, const PolarGrid& grid) : model_(model) {
    if (model == LightModel::uncorrelated) {
        return;
    }
    for (std::uint32_t m = 0; m <= kMostDegree; ++m) {
        Eigen::MatrixXd waves(grid.rows(), kMostDegree - m + 1);
        for (std::uint32_t i = 0; i < grid.rows(); ++i) {
            // sph_legendre is normalised with ∫ dφ = 2π; the cosine's and the sine's √2 make up
            // for their ∫ dφ = π.
            const double root = std::sqrt(2 * std::numbers::pi * grid.weights[i]);
            for (std::uint32_t l = m; l <= kMostDegree; ++l) {
                waves(i, l - m) = root * std::sqrt(variance_of_degree(l)) *
                                  std::sph_legendre(l, m, grid.thetas[i]);
            }
        }
        waves_.push_back(std::move(waves));
    }
}

std::uint32_t LightWaves::frequencies(LightModel model) {
    return model == LightModel::natural ? kMostDegree + 1 : kUncorrelatedFrequencies;
}

}  // namespace relume::factors
