#include "precompute/factors/light_waves.h"

#include "precompute/factors/factorise.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace relume::factors {
namespace {

using Imath::V3f;

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kMostDegree = 64;

// A light over the upper hemisphere, drawn from the model by its definition.
class RandomLight {
  public:
    static constexpr std::uint32_t kRows = 64;
    static constexpr std::uint32_t kColumns = 160;

    explicit RandomLight(std::mt19937& random) : values_(kRows * kColumns) {
        std::normal_distribution<double> normal;
        double all = 0;
        for (std::uint32_t l = 1; l <= kMostDegree; ++l) {
            all += (2.0 * l + 1) / (l * (l + 1.0));
        }
        // The constant is 1, of coefficient √4π, and the noise's mean square over the sphere 1.
        std::vector<double> of_cosine(kRows);
        std::vector<double> of_sine(kRows);
        for (std::uint32_t m = 0; m <= kMostDegree; ++m) {
            std::fill(of_cosine.begin(), of_cosine.end(), 0.0);
            std::fill(of_sine.begin(), of_sine.end(), 0.0);
            for (std::uint32_t l = m; l <= kMostDegree; ++l) {
                const double deviation =
                    std::sqrt(l == 0 ? 4 * kPi : 4 * kPi / (l * (l + 1.0) * all)) *
                    (m == 0 ? 1 : std::numbers::sqrt2);
                const double a = deviation * (l == 0 ? 1 : normal(random));
                const double b = deviation * normal(random);
                for (std::uint32_t i = 0; i < kRows; ++i) {
                    const double function = std::sph_legendre(l, m, theta_of(i));
                    of_cosine[i] += a * function;
                    of_sine[i] += b * function;
                }
            }
            for (std::uint32_t i = 0; i < kRows; ++i) {
                for (std::uint32_t j = 0; j < kColumns; ++j) {
                    const double phi = j * 2 * kPi / kColumns;
                    values_[i * kColumns + j] +=
                        of_cosine[i] * std::cos(m * phi) + of_sine[i] * std::sin(m * phi);
                }
            }
        }
    }

    [[nodiscard]] static double theta_of(std::uint32_t i) {
        return (i + 0.5) * kPi / 2 / kRows;
    }
    [[nodiscard]] double mean_square() const {
        double sum = 0;
        double whole = 0;
        for (std::uint32_t i = 0; i < kRows; ++i) {
            for (std::uint32_t j = 0; j < kColumns; ++j) {
                const double value = values_[i * kColumns + j];
                sum += value * value * std::sin(theta_of(i));
                whole += std::sin(theta_of(i));
            }
        }
        return sum / whole;
    }
    // ∫ function(ωi) L(ωi) cos θi dωi.
    [[nodiscard]] double reflected(const std::vector<double>& function) const {
        double sum = 0;
        for (std::uint32_t i = 0; i < kRows; ++i) {
            const double measure = std::cos(theta_of(i)) * std::sin(theta_of(i));
            for (std::uint32_t j = 0; j < kColumns; ++j) {
                sum += function[i * kColumns + j] * values_[i * kColumns + j] * measure;
            }
        }
        return sum * (kPi / 2 / kRows) * (2 * kPi / kColumns);
    }

  private:
    std::vector<double> values_;
};

TEST(LightWaves, AreAConstantAndNoiseOfTheSameStrength) {
    // ∫∫ over waves: the mean square over the sphere of all but the constant is the constant's.
    const PolarGrid grid(97);
    const LightWaves waves(LightModel::natural, grid);
    double constant = 0;
    double noise = 0;
    for (std::uint32_t m = 0; m < LightWaves::frequencies(LightModel::natural); ++m) {
        for (Eigen::Index wave = 0; wave < waves.of_frequency(m).cols(); ++wave) {
            for (std::uint32_t i = 0; i < grid.rows(); ++i) {
                // Twice: cosine and sine. Even functions of the sphere's height are twice here.
                const double value = waves.of_frequency(m)(i, wave);
                (m == 0 && wave == 0 ? constant : noise) += (m == 0 ? 1 : 2) * value * value;
            }
        }
    }
    // A field without preferred directions has one variance everywhere, whatever the weights.
    EXPECT_NEAR(noise / constant, 1, 1e-3);
}

// The error that is stated for natural light is the one that random natural lights show.
TEST(LightWaves, StateTheErrorOfImages) {
    const BrdfLobes lobes = lobes_of(scene::Bsdf::phong({0.1F, 0.2F, 0.3F}, V3f(0.5F), 30));
    const auto result = factorise("m", lobes, {.light = LightModel::natural, .terms = 6});
    std::mt19937 random(4);
    std::vector<RandomLight> lights;
    for (int i = 0; i < 40; ++i) {
        lights.emplace_back(random);
        EXPECT_NEAR(lights.back().mean_square(), 2, 1.5);
    }
    CosineDirections directions(6);
    double error = 0;
    double norm = 0;
    for (int view = 0; view < 40; ++view) {
        const V3f wo = directions.next();
        std::vector<double> values[3];
        std::vector<double> sums[3];
        for (std::uint32_t i = 0; i < RandomLight::kRows; ++i) {
            for (std::uint32_t j = 0; j < RandomLight::kColumns; ++j) {
                const V3f wi = direction_from_angles(RandomLight::theta_of(i),
                                                     j * 2 * kPi / RandomLight::kColumns);
                const V3f value = colour_of(lobes, wi, wo);
                const V3f sum = result.brdf.evaluate(wi, wo, lobes.mean_colours);
                for (int c = 0; c < 3; ++c) {
                    values[c].push_back(value[c]);
                    sums[c].push_back(sum[c]);
                }
            }
        }
        for (const RandomLight& light : lights) {
            for (int c = 0; c < 3; ++c) {
                const double exact = light.reflected(values[c]);
                error += std::pow(exact - light.reflected(sums[c]), 2);
                norm += exact * exact;
            }
        }
    }
    EXPECT_NEAR(std::sqrt(error / norm), result.error, 0.1 * result.error);
}

}  // namespace
}  // namespace relume::factors
