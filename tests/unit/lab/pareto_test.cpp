// The Pareto front, by its definition.
#include "tests/lab/measures/pareto.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <limits>

namespace relume::lab {
namespace {

bool beats(const CostAndError& a, const CostAndError& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
    const bool holds = rc::check([] {
        // Small integers, so that equal costs and errors occur.
        const auto numbers = *rc::gen::container<std::vector<std::pair<int, int>>>(
            rc::gen::pair(rc::gen::inRange(0, 6), rc::gen::inRange(0, 6)));
        std::vector<CostAndError> points;
        for (const auto& [cost, error] : numbers) {
            points.push_back({static_cast<double>(cost), static_cast<double>(error)});
        }
        const std::vector<std::size_t> front = pareto_front(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool beaten =
                std::any_of(points.begin(), points.end(),
                            [&](const CostAndError& other) { return beats(other, points[i]); });
            const bool in_front = std::find(front.begin(), front.end(), i) != front.end();
            RC_ASSERT(!(beaten && in_front));
            const bool represented =
                std::any_of(front.begin(), front.end(), [&](std::size_t f) {
                    return points[f].cost == points[i].cost &&
                           points[f].error == points[i].error;
                });
            RC_ASSERT(beaten || represented);
        }
        RC_ASSERT(std::is_sorted(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
            return points[a].cost < points[b].cost;
        }));
    });
    EXPECT_TRUE(holds);
}

TEST(ParetoFront, LeavesOutWhatWasNotMeasured) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<CostAndError> points{{nan, 0}, {0, nan}, {1, 1}};
    EXPECT_EQ(pareto_front(points), std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace relume::lab
