#include "protocol/basis/haar.h"

#include "protocol/basis/cubemap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace relume::basis {
namespace {

std::vector<float> random_cubemap(std::uint32_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::vector<float> values(texel_count(n));
    std::generate(values.begin(), values.end(), [&] { return normal(random); });
    return values;
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

TEST(Haar, MatchesTheWorkedExample) {
    std::vector<float> face(16);
    std::iota(face.begin(), face.end(), 1.0F);
    std::vector<float> scratch(16);
    haar_forward(4, face, scratch);
    const std::vector<float> expected{34, -4, -1, -1, -16, 0,  -1, -1,
                                      -4, -4, 0,  0,  -4,  -4, 0,  0};
    EXPECT_EQ(face, expected);
}

TEST(Haar, InvertsAndKeepsEnergyAndProducts) {
    for (const std::uint32_t n : {4U, 16U, 64U, 256U}) {
        const auto a = random_cubemap(n, 1);
        const auto b = random_cubemap(n, 2);
        auto a_coefficients = a;
        auto b_coefficients = b;
        haar_forward_cubemap(n, a_coefficients);
        haar_forward_cubemap(n, b_coefficients);
        EXPECT_NEAR(dot(a_coefficients, a_coefficients) / dot(a, a), 1, 1e-5);
        EXPECT_NEAR(dot(a_coefficients, b_coefficients), dot(a, b), 1e-5 * dot(a, a));
        haar_inverse_cubemap(n, a_coefficients);
        for (std::size_t i = 0; i < a.size(); ++i) {
            ASSERT_NEAR(a_coefficients[i], a[i], 1e-5F);
        }
    }
}

TEST(Haar, AConstantLivesInTheScalingFunctionsAlone) {
    constexpr std::uint32_t n = 32;
    std::vector<float> cubemap(texel_count(n), 1.0F);
    haar_forward_cubemap(n, cubemap);
    for (std::size_t j = 0; j < cubemap.size(); ++j) {
        EXPECT_EQ(cubemap[j], j % (n * n) == 0 ? static_cast<float>(n) : 0.0F);
    }
}

TEST(Haar, BandsPartitionTheCoefficients) {
    constexpr std::uint32_t n = 16;
    std::vector<std::size_t> counts(band_count(n));
    for (std::size_t j = 0; j < texel_count(n); ++j) {
        ++counts.at(band_from_coefficient(n, j));
    }
    EXPECT_EQ(counts, (std::vector<std::size_t>{24, 72, 288, 1152}));
}

TEST(Haar, AWaveletOfABandSpansThatBandsSquare) {
    constexpr std::uint32_t n = 16;
    for (std::size_t j = 0; j < std::size_t{n} * n; ++j) {
        std::vector<float> cubemap(texel_count(n), 0.0F);
        cubemap[j] = 1;
        haar_inverse_cubemap(n, cubemap);
        const auto support = std::count_if(cubemap.begin(), cubemap.end(),
                                           [](float value) { return value != 0; });
        const std::uint32_t side = n >> band_from_coefficient(n, j);
        EXPECT_EQ(support, side * side) << "coefficient " << j;
    }
}

}  // namespace
}  // namespace relume::basis
