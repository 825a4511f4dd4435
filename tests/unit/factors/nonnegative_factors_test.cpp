#include "precompute/factors/nonnegative_factors.h"

#include "precompute/factors/azimuthal_svd.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relume::factors {
namespace {

using Imath::V3f;

constexpr std::uint32_t kRows = 17;
constexpr std::uint32_t kColumns = 24;
constexpr std::size_t kMostTerms = 6;

struct Case {
    BrdfLobes lobes;
    AzimuthalSpectrum spectrum;
    std::vector<double> weights;
    std::vector<NonnegativeFactors> factors;

    explicit Case(BrdfLobes of)
        : lobes(std::move(of)),
          spectrum(lobes, kRows, frequencies_for_columns(kColumns)),
          weights(lobes.weights()),
          factors(nonnegative_factors(spectrum, weights, kColumns, kMostTerms)) {}

    // Σ_l w_l²·square of lobe l.
    [[nodiscard]] double weighted(const Eigen::MatrixXd& products) const {
        double sum = 0;
        for (std::size_t l = 0; l < weights.size(); ++l) {
            const auto i = static_cast<Eigen::Index>(l);
            sum += weights[l] * weights[l] * products(i, i);
        }
        return sum;
    }
};

std::vector<Case>& cases() {
    static std::vector<Case> all;
    if (all.empty()) {
        all.emplace_back(lobes_of(scene::Bsdf::phong({0.3F, 0.1F, 0.2F}, V3f(0.5F), 10)));
        all.emplace_back(lobes_of(scene::Bsdf::phong(V3f(0), V3f(1), 6)));
        all.emplace_back(lobes_of(scene::Bsdf::ggx(V3f(0.6F), 0, 0.8F)));
    }
    return all;
}

TEST(NonnegativeFactors, AreNowhereNegative) {
    for (const Case& of : cases()) {
        for (const NonnegativeFactors& factors : of.factors) {
            EXPECT_GE(factors.g.minCoeff(), 0);
            EXPECT_GT(factors.g.maxCoeff(), 0);
            for (const Eigen::MatrixXd& h : factors.h) {
                EXPECT_GE(h.minCoeff(), 0);
            }
        }
    }
}

TEST(NonnegativeFactors, ErrNoLessThanTheSingularValues) {
    for (const Case& of : cases()) {
        const double whole = of.weighted(of.spectrum.products());
        const auto terms =
            azimuthal_svd(of.spectrum, {LightModel::uncorrelated, of.spectrum.grid()},
                          of.weights, kMostTerms);
        double best = whole;
        for (std::size_t k = 0; k < kMostTerms; ++k) {
            best -= k < terms.size() ? terms[k].singular_value * terms[k].singular_value : 0;
            const double error = of.weighted(of.factors[k].error_products);
            EXPECT_GE(error, best - 1e-9 * whole) << k;
            // And not by much: the fit has found something.
            EXPECT_LE(std::sqrt(error / whole), std::sqrt(best / whole) + 0.12) << k;
        }
    }
}

TEST(NonnegativeFactors, ErrLessWithEveryTerm) {
    for (const Case& of : cases()) {
        double before = of.weighted(of.spectrum.products());
        for (const NonnegativeFactors& factors : of.factors) {
            const double error = of.weighted(factors.error_products);
            EXPECT_LT(error, before * (1 + 1e-9));
            before = error;
        }
    }
}

// The stated products of errors, by sums over all pairs of directions of the grid.
TEST(NonnegativeFactors, ErrAsTheyState) {
    const Case& of = cases()[0];
    const NonnegativeFactors& factors = of.factors[3];
    const PolarGrid& grid = of.spectrum.grid();
    const double step = 2 * std::numbers::pi / kColumns;
    Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(2, 2);
    for (std::uint32_t o = 0; o < kRows; ++o) {
        for (std::uint32_t jo = 0; jo < kColumns; jo += 3) {  // a pattern that repeats
            for (std::uint32_t i = 0; i < kRows; ++i) {
                for (std::uint32_t ji = 0; ji < kColumns; ++ji) {
                    const auto values =
                        values_of(of.lobes, direction_from_angles(grid.thetas[i], ji * step),
                                  direction_from_angles(grid.thetas[o], jo * step));
                    Eigen::Vector2d error;
                    for (Eigen::Index l = 0; l < 2; ++l) {
                        error[l] = values[static_cast<std::size_t>(l)] -
                                   factors.h[static_cast<std::size_t>(l)]
                                       .row(jo * kRows + o)
                                       .dot(factors.g.row(ji * kRows + i));
                    }
                    errors += error * error.transpose() * grid.weights[i] * grid.weights[o] *
                              3 * step * step;
                }
            }
        }
    }
    const double whole = of.weighted(of.spectrum.products());
    for (Eigen::Index a = 0; a < 2; ++a) {
        for (Eigen::Index b = 0; b < 2; ++b) {
            EXPECT_NEAR(errors(a, b) / whole, factors.error_products(a, b) / whole, 0.03);
        }
    }
}

TEST(NonnegativeFactors, FindAProductAtOnce) {
    const Case product(lobe_from(
        [](const V3f& wi, const V3f& wo) { return (0.2 + wi.z) * (1 + wo.z * wo.z); }));
    EXPECT_NEAR(std::sqrt(std::max(0.0, product.factors[0].error_products(0, 0)) /
                          product.spectrum.products()(0, 0)),
                0, 1e-4);
}

}  // namespace
}  // namespace relume::factors
