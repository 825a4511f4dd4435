#include "precompute/factors/azimuthal_svd.h"

#include "precompute/factors/term_errors.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relume::factors {
namespace {

using Imath::V3f;

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kRows = 25;

BrdfLobes phong(float exponent) {
    return lobes_of(scene::Bsdf::phong(V3f(0.4F), V3f(0.5F), exponent));
}

// Not reciprocal, and so that the mirror direction is nothing special.
BrdfLobes one_way() {
    return lobe_from([](const V3f& wi, const V3f& wo) {
        return std::exp(2 * wi.x * wo.x + 2 * wi.y * wo.y - wo.z) * (1 + 3 * wi.z * wi.z);
    });
}

LightWaves uncorrelated(const AzimuthalSpectrum& spectrum) {
    return {LightModel::uncorrelated, spectrum.grid()};
}

double wave(const AzimuthalTerm& term, double phi) {
    return term.is_sine ? std::sin(term.frequency * phi) : std::cos(term.frequency * phi);
}

// Σ_k h_{k,l}(θo, φo) g_k(θi, φi) of the first `terms`, at rows of the grid.
double sum_of(const std::vector<AzimuthalTerm>& all,
              std::size_t terms,
              std::size_t lobe,
              std::uint32_t i,
              double phi_i,
              std::uint32_t o,
              double phi_o) {
    double sum = 0;
    for (std::size_t k = 0; k < terms; ++k) {
        const AzimuthalTerm& term = all[k];
        sum += term.h(o, static_cast<Eigen::Index>(lobe)) * wave(term, phi_o) * term.g[i] *
               wave(term, phi_i);
    }
    return sum;
}

// The square of the error of the first `terms`, by sums over all pairs of directions of the
// grid, and Σ over lobes of their squares.
struct Squares {
    double error = 0;
    double whole = 0;
};

Squares squares_by_sums(const BrdfLobes& lobes,
                        const PolarGrid& grid,
                        const std::vector<AzimuthalTerm>& all,
                        std::size_t terms) {
    constexpr int kTurns = 48;
    const std::vector<double> weights = lobes.weights();
    Squares squares;
    for (std::uint32_t o = 0; o < grid.rows(); ++o) {
        for (std::uint32_t i = 0; i < grid.rows(); ++i) {
            for (int j = 0; j < kTurns; ++j) {
                // Pairs are whole here, so that φo − φi is all that counts.
                const double phi = (j + 0.5) * 2 * kPi / kTurns;
                const auto values = values_of(lobes, direction_from_angles(grid.thetas[i], phi),
                                              direction_from_angles(grid.thetas[o], 0));
                const double measure =
                    grid.weights[i] * grid.weights[o] * 4 * kPi * kPi / kTurns;
                for (std::size_t l = 0; l < lobes.count(); ++l) {
                    const double value = weights[l] * values[l];
                    const double sum = weights[l] * sum_of(all, terms, l, i, phi, o, 0);
                    squares.error += (value - sum) * (value - sum) * measure;
                    squares.whole += value * value * measure;
                }
            }
        }
    }
    return squares;
}

TEST(AzimuthalSvd, WithAllTermsIsTheBrdf) {
    // cos^8 has the frequencies 0 … 8 and no other.
    for (const BrdfLobes& lobes : {phong(8), one_way()}) {
        const AzimuthalSpectrum spectrum(lobes, kRows, 20);
        const auto terms =
            azimuthal_svd(spectrum, uncorrelated(spectrum), lobes.weights(), 100000);
        double largest = 0;
        for (std::uint32_t o = 0; o < kRows; o += 3) {
            for (std::uint32_t i = 0; i < kRows; i += 2) {
                for (const double phi : {0.0, 0.3, 2.0, 3.1415, 4.0}) {
                    const auto values = values_of(
                        lobes, direction_from_angles(spectrum.grid().thetas[i], phi + 1),
                        direction_from_angles(spectrum.grid().thetas[o], 1));
                    for (std::size_t l = 0; l < lobes.count(); ++l) {
                        const double sum = sum_of(terms, terms.size(), l, i, phi + 1, o, 1);
                        largest = std::max(largest, std::fabs(sum - values[l]));
                    }
                }
            }
        }
        EXPECT_LT(largest, 2e-5);
    }
}

TEST(AzimuthalSvd, ErrsAsTheTailOfItsSingularValues) {
    for (const BrdfLobes& lobes : {phong(12), one_way()}) {
        const AzimuthalSpectrum spectrum(lobes, kRows, 20);
        const auto terms =
            azimuthal_svd(spectrum, uncorrelated(spectrum), lobes.weights(), 100000);
        double before = 2;
        for (std::size_t k = 0; k <= 12; ++k) {
            if (k > 0 && terms[k - 1].frequency > 0 && !terms[k - 1].is_sine) {
                continue;  // a torn pair
            }
            double tail = 0;
            for (std::size_t rest = k; rest < terms.size(); ++rest) {
                tail += terms[rest].singular_value * terms[rest].singular_value;
            }
            const Squares squares = squares_by_sums(lobes, spectrum.grid(), terms, k);
            EXPECT_NEAR(std::sqrt(squares.error / squares.whole),
                        std::sqrt(tail / squares.whole), 1e-5)
                << k;
            EXPECT_LT(squares.error / squares.whole, before);
            before = squares.error / squares.whole;
        }
    }
}

TEST(AzimuthalSvd, HasOrthonormalFunctionsOfTheView) {
    const BrdfLobes lobes = phong(20);
    const std::vector<double> weights = lobes.weights();
    for (const LightModel model : {LightModel::uncorrelated, LightModel::natural}) {
        const AzimuthalSpectrum spectrum(lobes, kRows, LightWaves::frequencies(model));
        const auto terms = azimuthal_svd(spectrum, {model, spectrum.grid()}, weights, 12);
        ASSERT_EQ(terms.size(), 12U);
        for (std::size_t a = 0; a < terms.size(); ++a) {
            for (std::size_t b = 0; b < terms.size(); ++b) {
                double product = 0;
                for (int j = 0; j < 64; ++j) {
                    const double phi = j * 2 * kPi / 64;
                    for (std::uint32_t i = 0; i < kRows; ++i) {
                        for (Eigen::Index l = 0; l < 2; ++l) {
                            const double weight = weights[static_cast<std::size_t>(l)];
                            product += weight * weight * terms[a].h(i, l) *
                                       wave(terms[a], phi) * terms[b].h(i, l) *
                                       wave(terms[b], phi) * spectrum.grid().weights[i] * 2 *
                                       kPi / 64;
                        }
                    }
                }
                EXPECT_NEAR(product, a == b ? 1 : 0, 1e-9);
            }
        }
    }
}

// Errors as they are stated against errors by sums, lobe by lobe.
TEST(TermErrors, AreWhatTheTermsLeave) {
    const BrdfLobes lobes = phong(12);
    const std::vector<double> weights = lobes.weights();
    const AzimuthalSpectrum spectrum(lobes, kRows, 20);
    const LightWaves light = uncorrelated(spectrum);
    const auto terms = azimuthal_svd(spectrum, light, weights, 9);
    TermErrors left(spectrum, light);
    for (std::size_t k = 0; k <= terms.size(); ++k) {
        if (k > 0) {
            left.subtract(terms[k - 1]);
        }
        if (k > 0 && terms[k - 1].frequency > 0 && !terms[k - 1].is_sine) {
            continue;  // a torn pair
        }
        const Squares squares = squares_by_sums(lobes, spectrum.grid(), terms, k);
        const double stated = weights[0] * weights[0] * left.products()(0, 0) +
                              weights[1] * weights[1] * left.products()(1, 1);
        EXPECT_NEAR(std::sqrt(stated / squares.whole), std::sqrt(squares.error / squares.whole),
                    1e-5)
            << k;
    }
}

// In the light that they are for, singular values are what terms take away, and terms for
// another light take less.
TEST(TermErrors, AreLeastForTheLightThatTheTermsAreFor) {
    const BrdfLobes lobes = lobes_of(scene::Bsdf::phong(V3f(0), V3f(1), 25));
    const std::vector<double> weights = lobes.weights();
    const AzimuthalSpectrum spectrum(lobes, kRows,
                                     LightWaves::frequencies(LightModel::natural));
    const LightWaves natural(LightModel::natural, spectrum.grid());
    const auto terms = azimuthal_svd(spectrum, natural, weights, 10);
    const auto others = azimuthal_svd(spectrum, uncorrelated(spectrum), weights, 10);
    TermErrors left(spectrum, natural);
    TermErrors left_by_others(spectrum, natural);
    double tail = left.products()(1, 1);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        left.subtract(terms[k]);
        left_by_others.subtract(others[k]);
        tail -= terms[k].singular_value * terms[k].singular_value;
        EXPECT_NEAR(left.products()(1, 1), tail, 1e-9);
        EXPECT_LE(left.products()(1, 1), left_by_others.products()(1, 1) + 1e-12);
    }
    EXPECT_LT(left.products()(1, 1), 0.9 * left_by_others.products()(1, 1));
}

TEST(AzimuthalSvd, KeepsPairsTogetherInDescendingOrder) {
    const BrdfLobes lobes = phong(50);
    const AzimuthalSpectrum spectrum(lobes, kRows, 17);
    const auto terms = azimuthal_svd(spectrum, uncorrelated(spectrum), lobes.weights(), 16);
    ASSERT_EQ(terms.size(), 16U);
    for (std::size_t k = 0; k + 1 < terms.size(); ++k) {
        EXPECT_GE(terms[k].singular_value, terms[k + 1].singular_value);
        if (terms[k].frequency > 0 && !terms[k].is_sine) {
            EXPECT_EQ(terms[k + 1].frequency, terms[k].frequency);
            EXPECT_TRUE(terms[k + 1].is_sine);
            EXPECT_EQ(terms[k + 1].g, terms[k].g);
        }
    }
}

TEST(AzimuthalSvd, HasOneTermWhereTheBrdfIsAProduct) {
    const BrdfLobes product = lobe_from(
        [](const V3f& wi, const V3f& wo) { return (0.2 + wi.z) * (1 + wo.z * wo.z); });
    const AzimuthalSpectrum spectrum(product, kRows, 8);
    const auto terms = azimuthal_svd(spectrum, uncorrelated(spectrum), product.weights(), 16);
    ASSERT_EQ(terms.size(), 1U);
    EXPECT_NEAR(terms[0].singular_value * terms[0].singular_value, spectrum.products()(0, 0),
                1e-9);
    const BrdfLobes nothing = lobe_from([](const V3f&, const V3f&) { return 0; });
    const AzimuthalSpectrum none(nothing, 9, 4);
    EXPECT_EQ(azimuthal_svd(none, uncorrelated(none), nothing.weights(), 16).size(), 1U);
}

// Every frequency's energy is counted, also of those that no term reaches.
TEST(AzimuthalSpectrum, CountsTheWholeBrdf) {
    // ∬ cos^2e dμ dμ by sums against the spectrum's, which has three frequencies.
    const BrdfLobes lobes = phong(60);
    const AzimuthalSpectrum spectrum(lobes, 49, 3);
    const Squares squares = squares_by_sums(lobes, spectrum.grid(), {}, 0);
    const std::vector<double> weights = lobes.weights();
    EXPECT_NEAR((weights[0] * weights[0] * spectrum.products()(0, 0) +
                 weights[1] * weights[1] * spectrum.products()(1, 1)) /
                    squares.whole,
                1, 1e-4);
}

}  // namespace
}  // namespace relume::factors
