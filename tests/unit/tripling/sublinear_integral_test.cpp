#include "protocol/tripling/sublinear_integral.h"

#include "protocol/tripling/haar_tripling.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <vector>

namespace relume::tripling {
namespace {

struct Coefficients {
    std::uint32_t n = 0;
    std::vector<float> light, visibility, material;
};

Coefficients scene(std::uint32_t n, unsigned seed) {
    return {n, coefficients_of(n, random_cubemap(n, seed)),
            coefficients_of(n, random_visibility(n, seed + 1)),
            coefficients_of(n, random_cubemap(n, seed + 2))};
}

double texel_product(std::uint32_t n,
                     std::vector<float> light,
                     std::vector<float> visibility,
                     std::vector<float> material) {
    for (std::vector<float>* function : {&light, &visibility, &material}) {
        basis::haar_inverse_cubemap(n, *function);
    }
    double sum = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        sum += double{light[i]} * double{visibility[i]} * double{material[i]};
    }
    return sum;
}

TEST(SquareSet, FindsAndCountsWhatItHolds) {
    for (const std::uint32_t n : {1U, 2U, 8U, 64U}) {
        std::mt19937 random(n);
        std::bernoulli_distribution keep(0.1);
        std::vector<std::uint32_t> squares;
        for (std::uint32_t face = 0; face < basis::kFaceCount; ++face) {
            for (std::uint32_t i = 0; i < square_count(n); ++i) {
                if (keep(random)) {
                    squares.push_back(static_cast<std::uint32_t>(face * face_stride(n)) + i);
                }
            }
        }
        const SquareSet set(n, squares);
        EXPECT_EQ(set.size(), squares.size());
        std::size_t place = 0;
        for (std::uint32_t square = 0; square < square_stride(n); ++square) {
            const bool is_next = place < squares.size() && squares[place] == square;
            EXPECT_EQ(set.contains(square), is_next);
            EXPECT_EQ(set.rank(square), place);
            place += is_next ? 1 : 0;
        }
        std::vector<std::uint32_t> visited;
        set.for_each(
            [&](std::size_t square) { visited.push_back(static_cast<std::uint32_t>(square)); });
        EXPECT_EQ(visited, squares);
        const SquareSet closed = set.with_ancestors();
        closed.for_each([&](std::size_t square) {
            const std::size_t within = square % face_stride(n);
            EXPECT_TRUE(within == 0 ||
                        closed.contains(square - within + parent_square(within)));
        });
        set.for_each([&](std::size_t square) { EXPECT_TRUE(closed.contains(square)); });
    }
}

TEST(SparseWavelets, KeepWhatTheyAreGiven) {
    constexpr std::uint32_t n = 16;
    const auto coefficients = coefficients_of(n, random_visibility(n, 1));
    const SparseWavelets all(nonzero_squares(n, coefficients), coefficients);
    EXPECT_EQ(all.coefficients(), coefficients);
    EXPECT_EQ(all.nonzero_count() + basis::kFaceCount,
              static_cast<std::size_t>(std::count_if(coefficients.begin(), coefficients.end(),
                                                     [](float c) { return c != 0; })));
}

TEST(SparseWavelets, ChooseTheLargestFirst) {
    constexpr std::uint32_t n = 16;
    const auto coefficients = coefficients_of(n, random_cubemap(n, 4));
    double least_kept = 1e30;
    const SquareSet kept = largest_squares(n, coefficients, 40, TermOrder::by_size);
    const SparseWavelets sparse(kept, coefficients);
    for (const SquareCoefficients& square : sparse.values()) {
        const double largest =
            std::max({std::abs(square[0]), std::abs(square[1]), std::abs(square[2])});
        least_kept = std::min(least_kept, largest);
    }
    const auto values = sparse.coefficients();
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == 0) {
            EXPECT_LE(std::abs(coefficients[i]), least_kept);
        }
    }
    // A wavelet of level 0 covers twice what one of level 1 covers along each axis.
    std::vector<float> two(basis::texel_count(n), 0);
    two[1] = 1.0F;  // level 0
    two[2] = 1.9F;  // level 1
    EXPECT_TRUE(largest_squares(n, two, 1, TermOrder::by_area).contains(0));
    EXPECT_TRUE(largest_squares(n, two, 1, TermOrder::by_size).contains(1));
}

TEST(SparseWavelets, HoldTheEnergyTheyAreAskedFor) {
    constexpr std::uint32_t n = 32;
    const auto coefficients = coefficients_of(n, random_visibility(n, 9));
    const double energy =
        std::inner_product(coefficients.begin(), coefficients.end(), coefficients.begin(), 0.0);
    std::size_t before = 0;
    for (const double fraction : {0.0, 0.9, 0.99, 0.999, 1.0}) {
        const SquareSet kept = squares_of_energy(n, coefficients, fraction);
        const auto values = SparseWavelets(kept, coefficients).coefficients();
        const double held =
            std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
        EXPECT_GE(held, (fraction - 1e-6) * energy);
        EXPECT_EQ(kept.with_ancestors().size(), kept.size());
        EXPECT_GE(kept.size(), before);
        before = kept.size();
    }
    EXPECT_EQ(squares_of_energy(n, std::vector<float>(basis::texel_count(n), 0.0F), 1).size(),
              0U);
}

TEST(SublinearIntegral, OfAllTermsIsThePixelProduct) {
    for (const std::uint32_t n : {1U, 2U, 4U, 16U, 64U}) {
        const Coefficients c = scene(n, 40 + n);
        const SparseWavelets light(nonzero_squares(n, c.light), c.light);
        const SparseWavelets visibility(nonzero_squares(n, c.visibility), c.visibility);
        const SparseWavelets material(nonzero_squares(n, c.material), c.material);
        const double expected = texel_product(n, c.light, c.visibility, c.material);
        EXPECT_NEAR(sublinear_triple_integral(light, light.squares(), visibility, material),
                    expected, 1e-5 * static_cast<double>(basis::texel_count(n)));
    }
}

// All coefficients of light in the terms: the integral is that of the material as approximated.
TEST(SublinearIntegral, OfAllLightIsExactForTheMaterialGiven) {
    constexpr std::uint32_t n = 32;
    const Coefficients c = scene(n, 2);
    const SparseWavelets light(nonzero_squares(n, c.light), c.light);
    const SparseWavelets visibility(nonzero_squares(n, c.visibility), c.visibility);
    const SparseWavelets material(largest_squares(n, c.material, 30, TermOrder::by_size),
                                  c.material);
    EXPECT_NEAR(sublinear_triple_integral(light, light.squares(), visibility, material),
                texel_product(n, c.light, c.visibility, material.coefficients()), 1e-3);
}

// Equation 9 over the triples that the terms name, with the theorem's coefficients: what the
// material keeps against everything, and pairs of light and visibility that are kept.
TEST(SublinearIntegral, IsTheSumOverTheTriplesItIsGiven) {
    for (const std::uint32_t n : {2U, 4U, 8U}) {
        const Coefficients c = scene(n, 60 + n);
        const SparseWavelets light(nonzero_squares(n, c.light), c.light);
        const SquareSet light_terms = largest_squares(n, c.light, n, TermOrder::by_area);
        const SparseWavelets visibility(nonzero_squares(n, c.visibility), c.visibility);
        const SparseWavelets material(
            largest_squares(n, c.material, std::size_t{3} * n, TermOrder::by_size), c.material);
        const auto kept_material = material.coefficients();
        const auto kept_light = SparseWavelets(light_terms, c.light).coefficients();
        const std::size_t size = std::size_t{n} * n;
        double sum = 0;
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            const std::size_t first = face * size;
            for (std::size_t u = 0; u < size; ++u) {
                for (std::size_t v = 0; v < size; ++v) {
                    for (std::size_t w = 0; w < size; ++w) {
                        // A pair of light and visibility with a coarser function of the
                        // material.
                        const bool is_light_pair = u == v && u != w && u != 0;
                        const double l = (is_light_pair ? kept_light : c.light)[first + u];
                        sum += haar_tripling(n, u, v, w) * l * c.visibility[first + v] *
                               kept_material[first + w];
                    }
                }
            }
        }
        EXPECT_NEAR(sublinear_triple_integral(light, light_terms, visibility, material), sum,
                    1e-6 * std::abs(sum) + 1e-4);
    }
}

TEST(SublinearIntegral, ConvergesAsTermsAreAdded) {
    constexpr std::uint32_t n = 32;
    // A smooth light and a lobe: what wavelets are for.
    std::vector<float> light(basis::texel_count(n));
    std::vector<float> material(light.size());
    const Imath::V3f sun = Imath::V3f(0.3F, 0.8F, 0.4F).normalized();
    const Imath::V3f mirror = Imath::V3f(0.1F, 0.9F, 0.2F).normalized();
    for (std::size_t i = 0; i < light.size(); ++i) {
        const auto direction = basis::direction_from_texel(n, basis::texel_from_index(n, i));
        light[i] = 1 + direction.y + 20 * std::exp(60 * (direction.dot(sun) - 1));
        material[i] = std::pow(std::max(direction.dot(mirror), 0.0F), 64.0F);
    }
    const auto visibility = coefficients_of(n, random_visibility(n, 77));
    const auto l = coefficients_of(n, light);
    const auto p = coefficients_of(n, material);
    const double exact = texel_product(n, l, visibility, p);
    const SparseWavelets all_light(nonzero_squares(n, l), l);
    const SparseWavelets all_visibility(nonzero_squares(n, visibility), visibility);
    double before = 1e30;
    for (const std::size_t terms : {8U, 64U, 512U, 4096U, 18432U}) {
        const SparseWavelets approximation(largest_squares(n, p, terms, TermOrder::by_size), p);
        const double error =
            std::abs(sublinear_triple_integral(all_light,
                                               largest_squares(n, l, terms, TermOrder::by_area),
                                               all_visibility, approximation) -
                     exact);
        EXPECT_LE(error, before + 1e-4 * exact) << terms << " terms";
        before = error;
    }
    EXPECT_LE(before, 1e-5 * exact);
}

// Of few squares, few parent sums are found.
TEST(LazyParentSums, FindsThoseOnTheWayAlone) {
    constexpr std::uint32_t n = 64;
    const auto coefficients = coefficients_of(n, random_cubemap(n, 3));
    const SparseWavelets function(nonzero_squares(n, coefficients), coefficients);
    LazyParentSums sums(function);
    const std::size_t square = index_from_square({.level = 5, .row = 17, .column = 30});
    (void)sums.at(square);
    EXPECT_EQ(sums.known_count(), 6U);
    (void)sums.at(square - quadrant_in_parent(square) + 0);
    EXPECT_LE(sums.known_count(), 7U);
}

}  // namespace
}  // namespace relume::tripling
