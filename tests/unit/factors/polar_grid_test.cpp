#include "precompute/factors/polar_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace relume::factors {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

TEST(PolarGrid, HasTheRowsOfATableAndTheWholeHemisphere) {
    for (const std::uint32_t rows : {2U, 17U, 512U}) {
        const PolarGrid grid(rows);
        ASSERT_EQ(grid.rows(), rows);
        EXPECT_NEAR(std::accumulate(grid.weights.begin(), grid.weights.end(), 0.0), 0.5, 1e-14);
        for (std::uint32_t i = 0; i + 1 < rows; ++i) {
            EXPECT_DOUBLE_EQ(grid.thetas[i], i * kHalfPi / (rows - 1));
            EXPECT_GT(grid.weights[i], 0);
        }
        EXPECT_LT(grid.thetas.back(), kHalfPi);
        EXPECT_GT(grid.thetas.back(), kHalfPi * (1 - 0.5 / (rows - 1)));
    }
}

TEST(PolarGrid, IntegratesWithTheSquareOfTheStep) {
    // ∫ sin θ · cos θ sin θ dθ = 1/3.
    const auto error = [](std::uint32_t rows) {
        const PolarGrid grid(rows);
        double sum = 0;
        for (std::uint32_t i = 0; i < rows; ++i) {
            sum += std::sin(grid.thetas[i]) * grid.weights[i];
        }
        return std::fabs(sum - 1.0 / 3);
    };
    EXPECT_NEAR(error(33) / error(65), 4, 0.3);
    EXPECT_LT(error(65), 1e-3);
}

TEST(PolarGrid, FollowsTheWidthOfAHighlight) {
    EXPECT_EQ(rows_for_width(1), 49U);
    EXPECT_EQ(rows_for_width(1e-9), 512U);
    for (const double width : {0.01, 0.03, 0.06}) {
        const double step = kHalfPi / (rows_for_width(width) - 1);
        EXPECT_LE(step, width / 2);
        EXPECT_GT(step, width / 2 * 0.95);
    }
}

}  // namespace
}  // namespace relume::factors
