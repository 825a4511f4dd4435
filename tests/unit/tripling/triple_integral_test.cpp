#include "protocol/tripling/triple_integral.h"

#include "protocol/basis/haar.h"
#include "protocol/tripling/haar_product.h"
#include "protocol/tripling/haar_tripling.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace relume::tripling {
namespace {

std::vector<float> transformed(std::uint32_t n, std::vector<float> face) {
    std::vector<float> scratch(face.size());
    basis::haar_forward(n, face, scratch);
    return face;
}

template <typename Number>
struct Functions {
    std::vector<Number> light, visibility, material;

    [[nodiscard]] FaceTriple<Number> triple() const { return {light, visibility, material}; }
};

template <typename Number>
std::vector<Number> converted(const std::vector<float>& values) {
    return std::vector<Number>(values.begin(), values.end());
}

template <typename Number>
Functions<Number> coefficients(std::uint32_t n, const Functions<float>& texels) {
    return {converted<Number>(transformed(n, texels.light)),
            converted<Number>(transformed(n, texels.visibility)),
            converted<Number>(transformed(n, texels.material))};
}

Functions<float> random_texels(std::uint32_t n, unsigned seed, double density = 1) {
    const std::size_t count = std::size_t{n} * n;
    return {random_values(count, seed, density), random_values(count, seed + 1, density),
            random_values(count, seed + 2, density)};
}

// Σ |L·V·ρ̃| and a hundredth of the product of their norms: where few texels meet, rounding is
// that of the coefficients that cancel.
double absolute_product(const Functions<float>& texels) {
    const auto norm = [](const std::vector<float>& values) {
        return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
    };
    double sum = 1e-2 * norm(texels.light) * norm(texels.visibility) * norm(texels.material);
    for (std::size_t i = 0; i < texels.light.size(); ++i) {
        sum += std::abs(1.0 * texels.light[i] * texels.visibility[i] * texels.material[i]);
    }
    return sum;
}

constexpr std::array<std::uint32_t, 8> kResolutions{1, 2, 4, 8, 16, 32, 64, 256};

TEST(TripleIntegral, OfAllCoefficientsIsTheSumOverTexels) {
    for (const std::uint32_t n : kResolutions) {
        for (const double density : {1.0, 0.05}) {
            const Functions<float> texels = random_texels(n, 10 + n, density);
            const double expected = pixel_triple_product(FaceTriple<double>{
                converted<double>(texels.light), converted<double>(texels.visibility),
                converted<double>(texels.material)});
            const double scale = absolute_product(texels);
            const auto in_double = coefficients<double>(n, texels);
            const auto in_float = coefficients<float>(n, texels);
            const double tolerance = 1e-5 * scale;
            EXPECT_NEAR(linear_triple_integral(n, in_double.triple()), expected, tolerance);
            EXPECT_NEAR(linear_triple_integral(n, in_float.triple()), expected, tolerance);
            if (n <= 64) {
                EXPECT_NEAR(log_linear_triple_integral(n, in_double.triple()), expected,
                            tolerance);
                EXPECT_NEAR(log_linear_triple_integral(n, in_float.triple()), expected,
                            tolerance);
            }
        }
    }
}

// Equation 9 as it stands, with every coefficient of the theorem.
TEST(TripleIntegral, IsTheSumOverAllTriplingCoefficients) {
    for (const std::uint32_t n : {1U, 2U, 4U, 8U}) {
        const auto face = coefficients<double>(n, random_texels(n, 3));
        double sum = 0;
        for (std::size_t u = 0; u < face.light.size(); ++u) {
            for (std::size_t v = 0; v < face.light.size(); ++v) {
                for (std::size_t w = 0; w < face.light.size(); ++w) {
                    sum += haar_tripling(n, u, v, w) * face.light[u] * face.visibility[v] *
                           face.material[w];
                }
            }
        }
        EXPECT_NEAR(linear_triple_integral(n, face.triple()), sum, 1e-10);
        EXPECT_NEAR(log_linear_triple_integral(n, face.triple()), sum, 1e-10);
    }
}

TEST(TripleIntegral, DoesNotCareWhichFunctionIsWhich) {
    constexpr std::uint32_t n = 16;
    const auto face = coefficients<double>(n, random_texels(n, 5));
    const double integral = linear_triple_integral(n, face.triple());
    EXPECT_NEAR(linear_triple_integral<double>(n, {face.material, face.light, face.visibility}),
                integral, 1e-9);
    EXPECT_NEAR(linear_triple_integral<double>(n, {face.visibility, face.material, face.light}),
                integral, 1e-9);
}

// Large terms of different squares that leave little: a bright lamp that is hidden, under a
// material that mirrors it. What is left is right to a millionth of the terms.
TEST(TripleIntegral, SurvivesTermsThatCancel) {
    constexpr std::uint32_t n = 64;
    Functions<float> texels = random_texels(n, 7);
    for (float& value : texels.visibility) {
        value = value > 0 ? 1.0F : 0.0F;
    }
    constexpr std::size_t kLamp = 17 * n + 42;
    texels.light[kLamp] = 1e6F;
    texels.material[kLamp] = 1e3F;
    texels.visibility[kLamp] = 0;
    const double expected = pixel_triple_product(FaceTriple<double>{
        converted<double>(texels.light), converted<double>(texels.visibility),
        converted<double>(texels.material)});
    const auto face = coefficients<double>(n, texels);
    constexpr double kTerms = 1e9;
    EXPECT_NEAR(linear_triple_integral(n, face.triple()), expected, 1e-6 * kTerms);
    EXPECT_NEAR(log_linear_triple_integral(n, face.triple()), expected, 1e-6 * kTerms);
}

// A number that counts what is done with it.
struct Counted {
    Counted() = default;
    explicit Counted(double number) : value(number) {}
    explicit Counted(float number) : value(number) {}
    double value = 0;
    static inline std::uint64_t operations = 0;

    friend Counted operator*(const Counted& a, const Counted& b) {
        ++operations;
        return Counted(a.value * b.value);
    }
    friend Counted operator+(const Counted& a, const Counted& b) {
        ++operations;
        return Counted(a.value + b.value);
    }
    friend Counted operator-(const Counted& a, const Counted& b) {
        ++operations;
        return Counted(a.value - b.value);
    }
};

TEST(TripleIntegral, TakesLinearlyManyOperations) {
    for (const std::uint32_t n : {2U, 4U, 16U, 64U, 256U}) {
        const auto face = coefficients<Counted>(n, random_texels(n, 9));
        Counted::operations = 0;
        (void)linear_triple_integral(n, face.triple());
        const std::uint64_t squares = square_count(n);
        const std::uint64_t not_finest = square_count(n / 2);
        EXPECT_EQ(Counted::operations, 34 * squares + 9 * (squares - 1) / 3 + 24 * not_finest +
                                           2 * level_count(n) + 3);
        EXPECT_LE(Counted::operations, 14.4 * n * n + 40);
        if (n >= 16) {
            const std::uint64_t linear = Counted::operations;
            Counted::operations = 0;
            (void)log_linear_triple_integral(n, face.triple());
            EXPECT_GT(Counted::operations, linear);
        }
        Counted::operations = 0;
        (void)pixel_triple_product(face.triple());
        EXPECT_EQ(Counted::operations, 3 * std::uint64_t{n} * n);
    }
}

TEST(HaarProduct, IsEquation10) {
    for (const std::uint32_t n : {1U, 2U, 4U, 8U}) {
        const auto face = coefficients<double>(n, random_texels(n, 21));
        std::vector<double> product(face.light.size());
        haar_product(n, face.light, face.visibility, product);
        for (std::size_t u = 0; u < product.size(); ++u) {
            double sum = 0;
            for (std::size_t v = 0; v < product.size(); ++v) {
                for (std::size_t w = 0; w < product.size(); ++w) {
                    sum += haar_tripling(n, u, v, w) * face.light[v] * face.visibility[w];
                }
            }
            EXPECT_NEAR(product[u], sum, 1e-10);
        }
    }
}

TEST(HaarProduct, IsTheProductOfTexels) {
    for (const std::uint32_t n : kResolutions) {
        for (const double density : {1.0, 0.02}) {
            const Functions<float> texels = random_texels(n, 31 + n, density);
            const auto face = coefficients<double>(n, texels);
            std::vector<double> product(face.light.size());
            haar_product(n, face.light, face.visibility, product);
            std::vector<float> back(product.begin(), product.end());
            std::vector<float> scratch(back.size());
            basis::haar_inverse(n, back, scratch);
            for (std::size_t i = 0; i < back.size(); ++i) {
                ASSERT_NEAR(back[i], texels.light[i] * texels.visibility[i], 3e-5);
            }
            // With the third function it is the triple product integral.
            double integral = 0;
            for (std::size_t i = 0; i < product.size(); ++i) {
                integral += product[i] * face.material[i];
            }
            EXPECT_NEAR(integral, linear_triple_integral(n, face.triple()),
                        1e-9 * absolute_product(texels) + 1e-9);
        }
    }
}

}  // namespace
}  // namespace relume::tripling
