#include "protocol/basis/daubechies4.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace relume::basis {
namespace {

constexpr std::size_t kN = kDaubechies4Size;
using Values = std::array<float, kN>;

Values random_values(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Values values;
    for (float& value : values) {
        value = normal(random);
    }
    return values;
}

Values forward(const Values& samples) {
    Values coefficients;
    daubechies4_forward(samples, coefficients);
    return coefficients;
}

Values inverse(const Values& coefficients) {
    Values samples;
    daubechies4_inverse(coefficients, samples);
    return samples;
}

Values basis_function(std::size_t coefficient) {
    Values values{};
    values[coefficient] = 1;
    return inverse(values);
}

double dot(const Values& a, const Values& b) {
    double sum = 0;
    for (std::size_t i = 0; i < kN; ++i) {
        sum += static_cast<double>(a[i]) * b[i];
    }
    return sum;
}

TEST(Daubechies4, IsOrthonormal) {
    for (std::size_t i = 0; i < kN; ++i) {
        const Values a = basis_function(i);
        for (std::size_t j = i; j < kN; ++j) {
            ASSERT_NEAR(dot(a, basis_function(j)), i == j ? 1 : 0, 1e-6) << i << " " << j;
        }
    }
}

TEST(Daubechies4, InvertsAndKeepsEnergyAndProducts) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Values a = random_values(2 * seed);
        const Values b = random_values(2 * seed + 1);
        EXPECT_NEAR(dot(forward(a), forward(a)), dot(a, a), 1e-5 * dot(a, a));
        EXPECT_NEAR(dot(forward(a), forward(b)), dot(a, b), 1e-5 * dot(a, a));
        const Values back = inverse(forward(a));
        for (std::size_t i = 0; i < kN; ++i) {
            ASSERT_NEAR(back[i], a[i], 2e-6F);
        }
    }
}

TEST(Daubechies4, InPlaceGivesTheSameBits) {
    const Values a = random_values(5);
    Values values = a;
    daubechies4_forward(values, values);
    EXPECT_EQ(values, forward(a));
    daubechies4_inverse(values, values);
    EXPECT_EQ(values, inverse(forward(a)));
}

TEST(Daubechies4, AConstantIsSixteenInTheScalingCoefficient) {
    Values samples;
    samples.fill(0.25F);
    const Values coefficients = forward(samples);
    EXPECT_NEAR(coefficients[0], 4, 1e-6F);
    for (std::size_t j = 1; j < kN; ++j) {
        EXPECT_NEAR(coefficients[j], 0, 1e-7F);
    }
}

TEST(Daubechies4, MatchesTheWorkedExample) {
    Values line;
    for (std::size_t k = 0; k < kN; ++k) {
        line[k] = static_cast<float>(k) / 255;
    }
    const Values coefficients = forward(line);
    const std::pair<std::size_t, double> expected[]{
        {0, 8.000000}, {1, -2.691652},   {2, 0.676736},   {3, -2.590249},
        {4, 0.000000}, {127, -0.480643}, {255, -0.354940}};
    for (const auto& [j, value] : expected) {
        EXPECT_NEAR(coefficients[j], value, 2e-6) << j;
    }
}

// Whoever writes the transform a second time finds the same filters and the same order.
TEST(Daubechies4, TheFirstFinestWaveletIsTheFilter) {
    const double root3 = std::sqrt(3.0);
    const double scale = 1 / (4 * std::numbers::sqrt2);
    const Values wavelet = basis_function(128);
    EXPECT_NEAR(wavelet[0], (1 - root3) * scale, 1e-7);
    EXPECT_NEAR(wavelet[1], -(3 - root3) * scale, 1e-7);
    EXPECT_NEAR(wavelet[2], (3 + root3) * scale, 1e-7);
    EXPECT_NEAR(wavelet[3], -(1 + root3) * scale, 1e-7);
    for (std::size_t i = 4; i < kN; ++i) {
        EXPECT_EQ(wavelet[i], 0);
    }
    // The next one is moved by two samples, the last one wraps around.
    EXPECT_EQ(basis_function(129)[2], wavelet[0]);
    EXPECT_EQ(basis_function(255)[254], wavelet[0]);
    EXPECT_EQ(basis_function(255)[0], wavelet[2]);
}

// Wavelet i of level ℓ covers 3·m − 2 samples from m·i on, m = 256/2^ℓ; it ignores every line
// that it sees whole.
TEST(Daubechies4, LinesAreReproducedInside) {
    Values line;
    for (std::size_t i = 0; i < kN; ++i) {
        line[i] = 3 - 0.02F * static_cast<float>(i);
    }
    const Values coefficients = forward(line);
    std::size_t inside = 0;
    for (std::size_t j = 2; j < kN; ++j) {
        const std::size_t step = kN / std::bit_floor(j);
        const std::size_t first = (j - std::bit_floor(j)) * step;
        if (first + 3 * step - 2 <= kN) {
            ASSERT_NEAR(coefficients[j], 0, 3e-6F) << j;
            ++inside;
        }
    }
    // Of levels 1 … 6 two wrap around, of level 7 one.
    EXPECT_EQ(inside, kN - 2 - 2 * 6 - 1);
    // The ends differ, and the wavelet that wraps around tells.
    EXPECT_GT(std::fabs(coefficients[255]), 0.1F);
}

}  // namespace
}  // namespace relume::basis
