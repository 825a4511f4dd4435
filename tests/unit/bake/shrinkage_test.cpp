#include "precompute/bake/rows/shrinkage.h"

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/rows/path_tracer.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/sampling/sobol.h"
#include "protocol/transport/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::bake {
namespace {

constexpr std::uint32_t kN = 16;

float random_unit(std::uint64_t i) {
    return transport::unit_float(transport::mix_bits(i));
}

std::uint32_t key_of(std::uint32_t face, std::uint32_t row, std::uint32_t column) {
    return texel_key(kN, face, sampling::morton_index(column, row));
}

struct Contribution {
    std::uint32_t texel = 0;
    Imath::V3f value{0, 0, 0};
};

// Contributions anywhere on the sphere, of total weight one.
std::vector<Contribution> scattered(std::size_t count, std::uint64_t seed) {
    std::vector<Contribution> all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto texel =
            static_cast<std::uint32_t>(transport::mix_bits(seed + i) % basis::texel_count(kN));
        all.push_back({texel, Imath::V3f(0.5F, 1, 2) / static_cast<float>(count)});
    }
    return all;
}

std::array<std::vector<float>, 3> dense(const std::vector<Coefficient>& coefficients) {
    std::array<std::vector<float>, 3> row;
    for (std::size_t c = 0; c < 3; ++c) {
        row[c].resize(basis::texel_count(kN));
        for (const Coefficient& one : coefficients) {
            row[c][one.index] += one.value[static_cast<int>(c)];
        }
    }
    return row;
}

std::vector<Coefficient> project(const std::vector<Contribution>& contributions, float t) {
    SurfacePaths paths;
    paths.paths = 1;
    for (const auto& [texel, value] : contributions) {
        paths.escapes.push_back({.weight = value, .count = 1});
        paths.texels.push_back(texel);
    }
    EscapeSum escapes;
    escapes.reset(kN);
    escapes.add(paths, 1);
    std::vector<Coefficient> coefficients;
    project_with_shrinkage(escapes, t, coefficients);
    return coefficients;
}

TEST(Shrinkage, WithoutItTheProjectionIsTheHaarTransformOfTheBinnedPaths) {
    std::vector<Contribution> contributions;
    std::array<std::vector<float>, 3> binned;
    for (auto& plane : binned) {
        plane.resize(basis::texel_count(kN));
    }
    for (std::uint32_t i = 0; i < 300; ++i) {
        const auto texel = transport::mix_bits(i) % basis::texel_count(kN);
        const basis::Texel at = basis::texel_from_index(kN, texel);
        const Imath::V3f value{random_unit(3 * i), random_unit(3 * i + 1),
                               random_unit(3 * i + 2)};
        contributions.push_back(
            {key_of(static_cast<std::uint32_t>(at.face), at.row, at.column), value});
        for (std::size_t c = 0; c < 3; ++c) {
            binned[c][texel] += value[static_cast<int>(c)];
        }
    }
    const auto row = dense(project(contributions, 0));
    for (std::size_t c = 0; c < 3; ++c) {
        basis::haar_forward_cubemap(kN, binned[c]);
        for (std::size_t j = 0; j < binned[c].size(); ++j) {
            ASSERT_NEAR(row[c][j], binned[c][j], 1e-5) << j;
        }
    }
}

TEST(Shrinkage, KeepsTheEnergyOfEveryFace) {
    const auto contributions = scattered(100, 5);
    const auto with = dense(project(contributions, 2));
    const auto without = dense(project(contributions, 0));
    for (std::size_t face = 0; face < 6; ++face) {
        const std::size_t j = face * kN * kN;
        EXPECT_FLOAT_EQ(with[1][j], without[1][j]);
    }
}

TEST(Shrinkage, ASinglePathKeepsNoDetail) {
    const std::vector<Coefficient> kept = project({{key_of(2, 5, 9), Imath::V3f(1, 1, 1)}}, 2);
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].index, 2 * kN * kN);
}

TEST(Shrinkage, AUniformScatterLosesItsNoise) {
    const auto energy_of_detail = [](const std::vector<Coefficient>& coefficients) {
        double energy = 0;
        for (const Coefficient& one : coefficients) {
            energy += one.index % (kN * kN) != 0 ? double{one.value.length2()} : 0.0;
        }
        return energy;
    };
    const auto contributions = scattered(1000, 77);
    const double noise = energy_of_detail(project(contributions, 0));
    EXPECT_GT(noise, 0);
    EXPECT_LT(energy_of_detail(project(contributions, 2)), 0.05 * noise);
}

// A patch of six by six texels that nothing marks in the Haar basis, from a hundred paths: what
// shrinkage takes from it on average is a bias that no further seed brings back.
TEST(Shrinkage, ByDefaultAPatchOfLightIsLittleBlurredAndItsNoiseIsSmaller) {
    constexpr int kBakes = 60;
    constexpr std::uint32_t kPaths = 100;
    constexpr std::uint32_t kSide = 6;
    std::vector<double> truth(basis::texel_count(kN));
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        truth[basis::index_from_texel(kN, {basis::Face::positive_z, 3 + i / kSide,
                                           2 + i % kSide})] = 1.0 / (kSide * kSide);
    }
    std::vector<double> mean(truth.size());
    const auto squared_error = [&](float t) {
        std::fill(mean.begin(), mean.end(), 0.0);
        double sum = 0;
        for (std::uint64_t bake = 0; bake < kBakes; ++bake) {
            std::vector<Contribution> paths;
            for (std::uint32_t i = 0; i < kPaths; ++i) {
                const std::uint64_t bits = transport::mix_bits(bake * kPaths + i);
                const auto row = static_cast<std::uint32_t>(bits % kSide);
                const auto column = static_cast<std::uint32_t>((bits >> 32U) % kSide);
                paths.push_back({key_of(4, 3 + row, 2 + column), Imath::V3f(1.0F / kPaths)});
            }
            auto row = dense(project(paths, t));
            basis::haar_inverse_cubemap(kN, row[1]);
            for (std::size_t i = 0; i < truth.size(); ++i) {
                mean[i] += double{row[1][i]} / kBakes;
                sum += std::pow(double{row[1][i]} - truth[i], 2) / kBakes;
            }
        }
        return sum;
    };
    const double noisy = squared_error(0);
    EXPECT_LT(squared_error(BakeParameters{}.shrinkage), 0.6 * noisy);
    double bias = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        bias += std::pow(mean[i] - truth[i], 2);
    }
    EXPECT_LT(std::sqrt(bias * kSide * kSide), 0.3);
}

TEST(Shrinkage, ACausticKeepsItsFineDetail) {
    auto contributions = scattered(200, 9);
    for (auto& one : contributions) {
        one.value *= 0.2F;
    }
    for (int i = 0; i < 100; ++i) {
        contributions.push_back({key_of(4, 3, 12), Imath::V3f(0.01F, 0.01F, 0.01F)});
    }
    auto row = dense(project(contributions, 2));
    basis::haar_inverse_cubemap(kN, row[0]);
    const std::size_t texel = basis::index_from_texel(kN, {basis::Face::positive_z, 3, 12});
    EXPECT_GT(row[0][texel], 0.9F);
    EXPECT_LT(std::abs(row[0][texel + 1]), 0.1F);
}

}  // namespace
}  // namespace relume::bake
