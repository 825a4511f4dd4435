#include "protocol/basis/cubemap_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace relume::basis {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<CubemapBasis> bases() {
    std::vector<CubemapBasis> all;
    for (const std::uint32_t n : {4U, 16U, 64U}) {
        all.push_back(CubemapBasis::haar(n));
        for (const std::uint32_t order : {1U, 2U, 7U, 20U}) {
            all.push_back(CubemapBasis::spherical_harmonics(order, n));
        }
    }
    return all;
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<float> random_texels(std::uint32_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<float> values(texel_count(n));
    std::generate(values.begin(), values.end(), [&] { return uniform(random); });
    return values;
}

// The mean over a texel of a function of direction, by the plainest rule.
template <typename Function>
std::vector<float> texel_means(std::uint32_t n, Function function) {
    constexpr int kSteps = 4;
    std::vector<float> means;
    for (std::size_t i = 0; i < texel_count(n); ++i) {
        const Texel texel = texel_from_index(n, i);
        double sum = 0;
        double total = 0;
        for (int row = 0; row < kSteps; ++row) {
            for (int column = 0; column < kSteps; ++column) {
                const float u = (static_cast<float>(column) + 0.5F) / kSteps;
                const float v = (static_cast<float>(row) + 0.5F) / kSteps;
                const Imath::V3d d(direction_from_texel(n, texel, u, v));
                const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
                const double weight = largest * largest * largest;
                sum += weight * function(d);
                total += weight;
            }
        }
        means.push_back(static_cast<float>(sum / total));
    }
    return means;
}

TEST(CubemapProjection, TakesConstantLightToItsTerms) {
    for (const CubemapBasis& basis : bases()) {
        const auto projection = CubemapProjection::onto(basis);
        const std::vector<float> white(texel_count(basis.face_resolution()), 1.0F);
        std::vector<float> coefficients(basis.coefficient_count());
        projection->project_radiance(white, coefficients);
        for (const auto& [index, value] : basis.constant_light()) {
            EXPECT_NEAR(coefficients[index], value, 2e-6F * value);
            coefficients[index] = 0;
        }
        EXPECT_LT(std::sqrt(dot(coefficients, coefficients)), 1e-5);
    }
}

// A white furnace, whatever the response: the product is the sum of the response.
TEST(CubemapProjection, KeepsTheResponseToConstantLight) {
    for (const CubemapBasis& basis : bases()) {
        const auto projection = CubemapProjection::onto(basis);
        const auto response = random_texels(basis.face_resolution(), 1);
        std::vector<float> row(basis.coefficient_count());
        projection->project_response(response, row);
        double product = 0;
        for (const auto& [index, value] : basis.constant_light()) {
            product += double{row[index]} * double{value};
        }
        EXPECT_NEAR(product / std::accumulate(response.begin(), response.end(), 0.0), 1, 3e-6);
    }
}

// Σ_j T_j L_j is the response, texel by texel, to the light that the coefficients stand for.
TEST(CubemapProjection, ProductIsTheResponseToTheReconstructedLight) {
    for (const CubemapBasis& basis : bases()) {
        const auto projection = CubemapProjection::onto(basis);
        const auto response = random_texels(basis.face_resolution(), 2);
        const auto radiance = random_texels(basis.face_resolution(), 3);
        std::vector<float> row(basis.coefficient_count());
        std::vector<float> light(basis.coefficient_count());
        std::vector<float> reconstructed(radiance.size());
        projection->project_response(response, row);
        projection->project_radiance(radiance, light);
        projection->reconstruct_radiance(light, reconstructed);
        EXPECT_NEAR(dot(row, light) / dot(response, reconstructed), 1, 1e-5);
    }
}

TEST(CubemapProjection, IsLinear) {
    for (const CubemapBasis& basis : bases()) {
        const auto projection = CubemapProjection::onto(basis);
        const auto a = random_texels(basis.face_resolution(), 4);
        const auto b = random_texels(basis.face_resolution(), 5);
        auto sum = a;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += 3 * b[i];
        }
        std::vector<float> of_a(basis.coefficient_count());
        std::vector<float> of_b(basis.coefficient_count());
        std::vector<float> of_sum(basis.coefficient_count());
        projection->project_radiance(a, of_a);
        projection->project_radiance(b, of_b);
        projection->project_radiance(sum, of_sum);
        const double scale = std::sqrt(dot(of_sum, of_sum));
        for (std::size_t j = 0; j < of_sum.size(); ++j) {
            ASSERT_NEAR(of_sum[j], of_a[j] + 3 * of_b[j], 1e-5 * scale);
        }
    }
}

// What is left of orthonormality when functions are replaced by their means over texels: the
// square of a texel's size against a wave.
TEST(ShProjection, ComesBackFromItsOwnFunctions) {
    constexpr std::uint32_t kOrder = 10;
    double last_error = 1;
    for (const std::uint32_t n : {8U, 16U, 32U}) {
        const CubemapBasis basis = CubemapBasis::spherical_harmonics(kOrder, n);
        const auto projection = CubemapProjection::onto(basis);
        double worst = 0;
        for (const std::size_t function : {0U, 2U, 25U, 99U}) {
            const auto texels = texel_means(n, [&](const Imath::V3d& d) {
                std::vector<double> values(sh_count(kOrder));
                evaluate_sh(kOrder, d, values);
                return values[function];
            });
            std::vector<float> coefficients(basis.coefficient_count());
            projection->project_radiance(texels, coefficients);
            coefficients[function] -= 1;
            worst = std::max(worst, std::sqrt(dot(coefficients, coefficients)));
        }
        EXPECT_LT(worst, last_error / 3);
        last_error = worst;
    }
    EXPECT_LT(last_error, 0.02);
}

// The energy of a band does not depend on where the light stands, but for what means over
// texels take from it.
TEST(ShProjection, BandEnergyIsRotationInvariant) {
    constexpr std::uint32_t kOrder = 8;
    constexpr std::uint32_t kN = 32;
    const CubemapBasis basis = CubemapBasis::spherical_harmonics(kOrder, kN);
    const auto projection = CubemapProjection::onto(basis);
    const auto band_energies = [&](const Imath::V3d& towards) {
        const auto texels = texel_means(
            kN, [&](const Imath::V3d& d) { return std::exp(30 * (d.dot(towards) - 1)); });
        std::vector<float> coefficients(basis.coefficient_count());
        projection->project_radiance(texels, coefficients);
        std::vector<double> energies(kOrder);
        for (std::size_t j = 0; j < coefficients.size(); ++j) {
            energies[basis.band_from_coefficient(j)] +=
                double{coefficients[j]} * double{coefficients[j]};
        }
        return energies;
    };
    const auto reference = band_energies({0, 0, 1});
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 5; ++i) {
        const auto energies = band_energies(
            Imath::V3d(normal(random), normal(random), normal(random)).normalized());
        for (std::uint32_t l = 0; l < kOrder; ++l) {
            EXPECT_NEAR(energies[l] / reference[l], 1, 0.03) << l;
        }
    }
}

TEST(CubemapBasis, CountsCoefficientsAndBands) {
    const CubemapBasis haar = CubemapBasis::haar(64);
    EXPECT_EQ(haar.coefficient_count(), 6U * 64 * 64);
    EXPECT_EQ(haar.band_count(), 6U);
    const CubemapBasis harmonics = CubemapBasis::spherical_harmonics(20, 64);
    EXPECT_EQ(harmonics.coefficient_count(), 400U);
    EXPECT_EQ(harmonics.band_count(), 20U);
    for (const CubemapBasis& basis : bases()) {
        EXPECT_LE(basis.band_count(), kMaxBands);
        EXPECT_EQ(basis.band_from_coefficient(0), 0U);
        EXPECT_EQ(basis.band_from_coefficient(basis.coefficient_count() - 1),
                  basis.band_count() - 1);
    }
}

TEST(CubemapBasis, RefusesWhatNoBasisHas) {
    EXPECT_THROW((void)CubemapBasis::haar(12), std::invalid_argument);
    EXPECT_THROW((void)CubemapBasis::spherical_harmonics(5, 512), std::invalid_argument);
    EXPECT_THROW((void)CubemapBasis::spherical_harmonics(0, 16), std::invalid_argument);
    EXPECT_THROW((void)CubemapBasis::spherical_harmonics(kMaxShOrder + 1, 16),
                 std::invalid_argument);
}

}  // namespace
}  // namespace relume::basis
