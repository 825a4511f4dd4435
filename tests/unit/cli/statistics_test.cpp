#include "client/cli/statistics.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace relume::cli {
namespace {

TEST(Statistics, PercentilesAreNearestRank) {
    const std::vector<double> values{15, 20, 35, 40, 50};
    EXPECT_EQ(percentile(values, 0.0), 15);
    EXPECT_EQ(percentile(values, 0.05), 15);
    EXPECT_EQ(percentile(values, 0.30), 20);
    EXPECT_EQ(percentile(values, 0.40), 20);
    EXPECT_EQ(percentile(values, 0.50), 35);
    EXPECT_EQ(percentile(values, 1.0), 50);
    EXPECT_EQ(percentile(std::vector<double>{7}, 0.99), 7);
}

RC_GTEST_PROP(Statistics, AtLeastTheFractionIsNotAboveThePercentile, ()) {
    const auto integers = *rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<int>>());
    std::vector<double> values(integers.begin(), integers.end());
    std::sort(values.begin(), values.end());
    const double fraction = *rc::gen::inRange(0, 101) / 100.0;
    const double p = percentile(values, fraction);
    const auto count = static_cast<double>(values.size());
    const auto not_above = static_cast<double>(
        std::count_if(values.begin(), values.end(), [p](double v) { return v <= p; }));
    const auto below = static_cast<double>(
        std::count_if(values.begin(), values.end(), [p](double v) { return v < p; }));
    RC_ASSERT(not_above >= fraction * count - 1e-9);
    RC_ASSERT(below < std::max(fraction * count, 1.0));
}

TEST(Statistics, TheSpreadOfNothingIsNull) {
    nlohmann::json object;
    put_spread(object, "x", spread_of({}));
    EXPECT_TRUE(object.at("x_p50").is_null());
    put_spread(object, "x", spread_of({10, 2, 3, 1}));
    EXPECT_EQ(object.at("x_p50"), 2);
    EXPECT_EQ(object.at("x_p99"), 10);
    EXPECT_EQ(object.at("x_mean"), 4);
    EXPECT_EQ(object.at("x_max"), 10);
}

}  // namespace
}  // namespace relume::cli
