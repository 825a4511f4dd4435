#include "server/net/rooms/step_budget.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

relighting::Budget of_milliseconds(double milliseconds) {
    return {.milliseconds = milliseconds, .coefficients = {}, .target_error = 0};
}
relighting::Budget of_coefficients(std::uint32_t count) {
    return {.milliseconds = {}, .coefficients = count, .target_error = 0};
}

TEST(StepBudget, IsForTheWholeWayFromEditToPicture) {
    StepBudget budget(16);
    for (int i = 0; i < 100; ++i) {
        budget.begin_step(2);
        budget.composing_took(1);
    }
    budget.set_overhead(3);
    EXPECT_NEAR(budget.lighting_ms(), 2, 1e-6);
    EXPECT_NEAR(*budget.for_slice(of_milliseconds(20), 1).milliseconds, 20 - 2 - 1 - 3, 1e-6);
    budget.slice_took(4, 10);
    // The light has been made; what the slice spent is gone.
    EXPECT_NEAR(*budget.for_slice(of_milliseconds(20), 1).milliseconds, 20 - 1 - 3 - 4, 1e-6);
}

TEST(StepBudget, RelightingKeepsAPartHoweverSlowTheRestIs) {
    StepBudget budget(16);
    budget.set_overhead(1000);
    const double left = *budget.for_slice(of_milliseconds(10), 1).milliseconds;
    EXPECT_GT(left, 0);
    EXPECT_LT(left, 10);
}

TEST(StepBudget, SlicesOfOneStepTakeNoMoreThanItHas) {
    StepBudget budget(16);
    budget.begin_step(0);
    EXPECT_EQ(budget.for_slice(of_coefficients(100), 1).coefficients, 100U);
    budget.slice_took(16, 60);
    EXPECT_FALSE(budget.is_spent(of_coefficients(100)));
    EXPECT_EQ(budget.for_slice(of_coefficients(100), 1).coefficients, 40U);
    budget.slice_took(16, 40);
    EXPECT_TRUE(budget.is_spent(of_coefficients(100)));
    // An image that goes on converging has all of it again.
    EXPECT_EQ(budget.for_slice(of_coefficients(100), 1).coefficients, 100U);
    // New light begins a new step.
    budget.begin_step(0);
    EXPECT_FALSE(budget.is_spent(of_coefficients(100)));
}

TEST(StepBudget, AStepEndsWhateverItCounts) {
    StepBudget budget(16);
    budget.begin_step(0);
    budget.slice_took(1000, 1);
    EXPECT_TRUE(budget.is_spent(of_coefficients(1'000'000)));
}

TEST(StepBudget, WhatIsNotWorthASliceIsNotWaitedFor) {
    StepBudget budget(16);
    budget.begin_step(0);
    EXPECT_FALSE(budget.is_spent(of_milliseconds(8))) << "no slice has run";
    budget.slice_took(1, 1);
    EXPECT_TRUE(budget.is_spent(of_milliseconds(8))) << "one slice holds it all";
    EXPECT_FALSE(budget.is_spent(of_milliseconds(64)));
    budget.slice_took(61, 1);
    EXPECT_TRUE(budget.is_spent(of_milliseconds(64)));
}

}  // namespace
}  // namespace relume::net
