#include "protocol/basis/spherical_harmonics.h"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace relume::basis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kOrder = 21;  // one more than any transport has

std::vector<double> values_at(const Imath::V3d& direction, std::uint32_t order = kOrder) {
    std::vector<double> values(sh_count(order));
    evaluate_sh(order, direction, values);
    return values;
}

Imath::V3d random_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return Imath::V3d(normal(random), normal(random), normal(random)).normalized();
}

TEST(SphericalHarmonics, HaveTheClosedFormsOfTheLowBands) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20; ++i) {
        const Imath::V3d d = random_direction(random);
        const auto [x, y, z] = d;
        const double second = std::sqrt(15 / (4 * kPi));
        const double expected[] = {std::sqrt(1 / (4 * kPi)),
                                   std::sqrt(3 / (4 * kPi)) * y,
                                   std::sqrt(3 / (4 * kPi)) * z,
                                   std::sqrt(3 / (4 * kPi)) * x,
                                   second * x * y,
                                   second * y * z,
                                   std::sqrt(5 / (16 * kPi)) * (3 * z * z - 1),
                                   second * x * z,
                                   second / 2 * (x * x - y * y)};
        const auto values = values_at(d);
        for (std::size_t j = 0; j < std::size(expected); ++j) {
            EXPECT_NEAR(values[j], expected[j], 1e-15) << j;
        }
    }
}

// protocol/README.md §1.
TEST(SphericalHarmonics, MatchTheWorkedExample) {
    const auto values = values_at({2.0 / 3, -1.0 / 3, 2.0 / 3}, 3);
    const double expected[] = {0.282095,  -0.162868, 0.325735, 0.325735, -0.242789,
                               -0.242789, 0.105131,  0.485577, 0.182091};
    for (std::size_t j = 0; j < std::size(expected); ++j) {
        EXPECT_NEAR(values[j], expected[j], 1e-6) << j;
    }
}

// std::sph_legendre has the Condon–Shortley sign (−1)^m, which ours have not.
TEST(SphericalHarmonics, AgreeWithTheStandardLibraryUpToBandTwenty) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20; ++i) {
        const Imath::V3d d = random_direction(random);
        const double polar = std::atan2(std::hypot(d.x, d.y), d.z);
        const double azimuth = std::atan2(d.y, d.x);
        const auto values = values_at(d);
        for (std::uint32_t l = 0; l < kOrder; ++l) {
            for (std::uint32_t m = 0; m <= l; ++m) {
                const auto signed_m = static_cast<std::int32_t>(m);
                const double legendre = (m % 2 == 0 ? 1 : -1) * std::sph_legendre(l, m, polar);
                const double scale = m == 0 ? 1 : std::numbers::sqrt2;
                EXPECT_NEAR(values[sh_index(l, signed_m)],
                            scale * legendre * std::cos(m * azimuth), 1e-12);
                if (m > 0) {
                    EXPECT_NEAR(values[sh_index(l, -signed_m)],
                                scale * legendre * std::sin(m * azimuth), 1e-12);
                }
            }
        }
    }
}

// Products of two functions of band 20 are polynomials of degree 40: Gauss's rule in z with 21
// points and 41 equal steps of azimuth integrate them exactly.
TEST(SphericalHarmonics, AreOrthonormal) {
    using Gauss = boost::math::quadrature::gauss<double, 21>;
    constexpr int kAzimuths = 41;
    const std::size_t count = sh_count(kOrder);
    std::vector<double> products(count * count);
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
        for (const double side : {-1.0, 1.0}) {
            const double z = side * Gauss::abscissa()[i];
            // The middle point of an odd rule is listed once and met twice.
            const double weight =
                Gauss::weights()[i] * (z == 0 ? 0.5 : 1) * 2 * kPi / kAzimuths;
            for (int step = 0; step < kAzimuths; ++step) {
                const double azimuth = 2 * kPi * step / kAzimuths;
                const double sine = std::sqrt(1 - z * z);
                const auto v =
                    values_at({sine * std::cos(azimuth), sine * std::sin(azimuth), z});
                for (std::size_t a = 0; a < count; ++a) {
                    for (std::size_t b = 0; b <= a; ++b) {
                        products[a * count + b] += weight * v[a] * v[b];
                    }
                }
            }
        }
    }
    double worst = 0;
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
            worst = std::max(worst, std::abs(products[a * count + b] - (a == b ? 1 : 0)));
        }
    }
    EXPECT_LT(worst, 1e-12);
}

// Σ_m Y(a)·Y(b) = (2l+1)/4π · P_l(a·b): the energy of a band under any rotation of the light.
TEST(SphericalHarmonics, ObeyTheAdditionTheorem) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 50; ++i) {
        const Imath::V3d a = random_direction(random);
        const Imath::V3d b = i == 0 ? a : random_direction(random);
        const auto of_a = values_at(a);
        const auto of_b = values_at(b);
        const double cosine = std::min(a.dot(b), 1.0);
        for (std::uint32_t l = 0; l < kOrder; ++l) {
            double sum = 0;
            for (std::size_t j = sh_count(l); j < sh_count(l + 1); ++j) {
                EXPECT_EQ(sh_band_from_index(j), l);
                sum += of_a[j] * of_b[j];
            }
            EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPi) * std::legendre(l, cosine), 1e-12);
        }
    }
}

TEST(SphericalHarmonics, AreEvenOrOddUnderMirrors) {
    std::mt19937_64 random(4);
    const Imath::V3d d = random_direction(random);
    const auto values = values_at(d);
    for (std::uint32_t mirror = 0; mirror < 8; ++mirror) {
        Imath::V3d mirrored = d;
        for (int axis = 0; axis < 3; ++axis) {
            mirrored[axis] *= (mirror >> axis & 1U) != 0 ? -1 : 1;
        }
        const auto of_mirrored = values_at(mirrored);
        for (std::size_t j = 0; j < values.size(); ++j) {
            const double sign = std::popcount(mirror & sh_parity(j)) % 2 == 0 ? 1 : -1;
            EXPECT_NEAR(of_mirrored[j], sign * values[j], 1e-13) << mirror << " " << j;
        }
    }
}

TEST(SphericalHarmonics, StandAtThePoles) {
    for (const double z : {1.0, -1.0}) {
        const auto values = values_at({0, 0, z});
        for (std::uint32_t l = 0; l < kOrder; ++l) {
            for (std::size_t j = sh_count(l); j < sh_count(l + 1); ++j) {
                const double expected =
                    j == sh_index(l, 0) ? std::sqrt((2 * l + 1) / (4 * kPi)) * std::pow(z, l)
                                        : 0;
                EXPECT_NEAR(values[j], expected, 1e-13);
            }
        }
    }
}

}  // namespace
}  // namespace relume::basis
