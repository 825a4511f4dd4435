#include "protocol/tripling/visibility_wavelets.h"

#include "protocol/tripling/wavelet_store.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace relume::tripling {
namespace {

// The coefficients of the bits, zeros left out, and no other value but n = 256's coarsest
// level, which is within half a step.
TEST(VisibilityWavelets, HoldTheTransformOfTheBits) {
    for (const std::uint32_t n : {1U, 2U, 4U, 16U, 64U, 256U}) {
        VisibilityWavelets field(n);
        std::vector<std::vector<float>> expected;
        std::size_t nonzero = 0;
        const std::size_t texels = basis::texel_count(n);
        for (const auto& open :
             {std::vector<float>(texels, 1.0F), random_visibility(n, n),
              std::vector<float>(texels, 0.0F), random_visibility(n, n + 1)}) {
            field.append(bits_of(open));
            expected.push_back(coefficients_of(n, open));
            nonzero += static_cast<std::size_t>(std::count_if(expected.back().begin(),
                                                              expected.back().end(),
                                                              [](float c) { return c != 0; }));
            for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
                nonzero -= std::size_t{expected.back()[face * n * n] != 0};
            }
        }
        EXPECT_EQ(field.point_count(), expected.size());
        EXPECT_EQ(field.nonzero_count(), nonzero);
        for (std::size_t point = 0; point < expected.size(); ++point) {
            const auto coefficients = field.sparse(point).coefficients();
            for (std::size_t i = 0; i < coefficients.size(); ++i) {
                ASSERT_NEAR(coefficients[i], expected[point][i], n == 256 ? 1.0F / 256 : 0)
                    << "coefficient " << i << " of n = " << n;
            }
        }
    }
}

TEST(VisibilityWavelets, FindASquareOrSayThatItIsNotThere) {
    constexpr std::uint32_t n = 32;
    VisibilityWavelets field(n);
    field.append(bits_of(random_visibility(n, 5)));
    field.append(bits_of(random_visibility(n, 6)));
    const SparseWavelets sparse = field.sparse(1);
    for (std::size_t square = 0; square < square_stride(n); ++square) {
        std::array<float, 3> found{-1, -1, -1};
        const bool is_there = read_visible_square(n, field.point(1), square / face_stride(n),
                                                  square % face_stride(n), found.data());
        EXPECT_EQ(is_there, sparse.squares().contains(square));
        EXPECT_EQ(found, is_there ? sparse.at(square) : (SquareCoefficients{-1, -1, -1}));
    }
}

TEST(WaveletStore, GivesBackWhatItIsGiven) {
    constexpr std::uint32_t n = 16;
    WaveletStore store(n);
    std::vector<SparseWavelets> functions;
    for (const std::size_t terms : {0U, 7U, 300U}) {
        const auto coefficients = coefficients_of(n, random_cubemap(n, 3));
        functions.emplace_back(largest_squares(n, coefficients, terms, TermOrder::by_size),
                               coefficients);
        store.append(functions.back());
    }
    ASSERT_EQ(store.size(), functions.size());
    for (std::size_t i = 0; i < functions.size(); ++i) {
        const WaveletView view = store.view(i);
        EXPECT_TRUE(std::equal(view.scaling.begin(), view.scaling.end(),
                               functions[i].scaling().begin()));
        ASSERT_EQ(view.first.back(), functions[i].values().size());
        std::size_t place = 0;
        functions[i].squares().for_each([&](std::size_t square) {
            const std::size_t face = square / face_stride(n);
            EXPECT_LE(view.first[face], place);
            EXPECT_LT(place, view.first[face + 1]);
            EXPECT_EQ(view.squares[place], square % face_stride(n));
            const SquareCoefficients& expected = functions[i].values()[place];
            EXPECT_EQ(view.values[place],
                      (SquareLanes{0, expected[0], expected[1], expected[2]}));
            ++place;
        });
    }
    EXPECT_THROW(store.append(SparseWavelets(SquareSet(8), {}, {})), std::invalid_argument);
}

}  // namespace
}  // namespace relume::tripling
