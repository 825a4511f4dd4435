#include "protocol/tripling/haar_tripling.h"

#include "protocol/basis/haar.h"
#include "protocol/tripling/wavelet_square.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace relume::tripling {
namespace {

TEST(WaveletSquares, AreCountedAsAHeap) {
    for (std::size_t i = 0; i < square_count(32); ++i) {
        const WaveletSquare square = square_from_index(i);
        EXPECT_EQ(index_from_square(square), i);
        EXPECT_EQ(level_from_square(i), square.level);
        for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
            const WaveletSquare child = square_from_index(first_child(i) + quadrant);
            EXPECT_EQ(child, (WaveletSquare{.level = square.level + 1,
                                            .row = 2 * square.row + quadrant / 2,
                                            .column = 2 * square.column + quadrant % 2}));
            EXPECT_EQ(parent_square(first_child(i) + quadrant), i);
            EXPECT_EQ(quadrant_in_parent(first_child(i) + quadrant), quadrant);
        }
    }
}

// Every coefficient but the scaling function's is that of one wavelet.
TEST(WaveletSquares, HoldAllWaveletsOfAFace) {
    for (const std::uint32_t n : {1U, 2U, 4U, 16U}) {
        std::set<std::size_t> coefficients{0};
        for (std::size_t i = 0; i < square_count(n); ++i) {
            for (const WaveletType type : kWaveletTypes) {
                coefficients.insert(coefficient_from_wavelet(n, square_from_index(i), type));
            }
        }
        EXPECT_EQ(coefficients.size(), std::size_t{n} * n);
        EXPECT_LT(*coefficients.rbegin(), std::size_t{n} * n);
    }
}

TEST(HaarTripling, IsAboutTheFunctionsOfTheTransform) {
    for (const std::uint32_t n : {1U, 2U, 4U, 8U}) {
        for (std::size_t u = 0; u < std::size_t{n} * n; ++u) {
            std::vector<float> face(std::size_t{n} * n, 0);
            std::vector<float> scratch(face.size());
            face[u] = 1;
            basis::haar_inverse(n, face, scratch);
            for (std::uint32_t texel = 0; texel < n * n; ++texel) {
                EXPECT_FLOAT_EQ(static_cast<float>(haar_value(n, u, texel / n, texel % n)),
                                face[texel]);
            }
        }
    }
}

// The theorem of [Ng04 §4.5.2] and the counts of its appendix B.3, by summing the products of
// all triples of functions over all texels.
TEST(HaarTripling, IsTheSumOverTexelsForEveryTriple) {
    for (const std::uint32_t n : {1U, 2U, 4U, 8U}) {
        const std::size_t functions = std::size_t{n} * n;
        std::vector<double> values;  // [function][texel]
        for (std::size_t u = 0; u < functions; ++u) {
            for (std::uint32_t texel = 0; texel < functions; ++texel) {
                values.push_back(haar_value(n, u, texel / n, texel % n));
            }
        }
        std::uint64_t nonzero = 0;
        for (std::size_t u = 0; u < functions; ++u) {
            for (std::size_t v = 0; v < functions; ++v) {
                for (std::size_t w = 0; w < functions; ++w) {
                    double sum = 0;
                    for (std::size_t texel = 0; texel < functions; ++texel) {
                        sum += values[u * functions + texel] * values[v * functions + texel] *
                               values[w * functions + texel];
                    }
                    nonzero += sum != 0 ? 1 : 0;
                    ASSERT_EQ(haar_tripling(n, u, v, w), sum)
                        << u << ", " << v << ", " << w << " of n = " << n;
                }
            }
        }
        EXPECT_EQ(nonzero, haar_tripling_count(n).total());
    }
}

TEST(HaarTripling, CountsAreThoseOfTheThreeCases) {
    for (const std::uint32_t n : {1U, 2U, 4U, 8U, 64U, 256U}) {
        const std::uint64_t functions = std::uint64_t{n} * n;
        const std::uint64_t log4 = level_count(n);
        const HaarTriplingCount count = haar_tripling_count(n);
        EXPECT_EQ(count.case_1, 1U);
        EXPECT_EQ(count.case_2, 2 * functions - 2);
        EXPECT_EQ(count.as_in_appendix_b() + functions, 2 + 3 * functions * log4);
        EXPECT_EQ(count.total() + 7 * functions, 8 + 9 * functions * log4);
    }
}

}  // namespace
}  // namespace relume::tripling
