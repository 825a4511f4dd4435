// Errors of methods at equal cost.
#include "tests/lab/measures/equal_cost.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::lab {
namespace {

TEST(EqualCost, IsTheLeastErrorWithinTheCost) {
    const std::vector<CostedMethod> methods{{"a", {.cost = 1, .error = 0.5}},
                                            {"b", {.cost = 3, .error = 0.1}},
                                            {"a", {.cost = 2, .error = 0.2}},
                                            {"a", {.cost = 4, .error = 0.3}}};
    const std::vector<double> costs{0.5, 1, 2, 3, 10};
    const std::vector<EqualCostRow> rows = errors_at_equal_cost(methods, costs);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].series, "a");
    EXPECT_TRUE(std::isnan(rows[0].errors[0]));
    EXPECT_EQ(rows[0].errors[1], 0.5);
    EXPECT_EQ(rows[0].errors[2], 0.2);
    EXPECT_EQ(rows[0].errors[4], 0.2);  // what costs more and leaves more is not taken
    EXPECT_TRUE(std::isnan(rows[1].errors[2]));
    EXPECT_EQ(rows[1].errors[3], 0.1);
}

}  // namespace
}  // namespace relume::lab
