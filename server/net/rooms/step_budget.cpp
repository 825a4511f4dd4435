#include "server/net/rooms/step_budget.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace relume::net {

namespace {

// So much of an image's time goes to relighting, however slow the rest is: in less, hardly more
// than choosing gets done, and pictures come sooner but far off.
constexpr double kLeastPart = 0.2;
// So much of a slice is not worth one.
constexpr double kLeastSlice = 0.25;
// The largest budget in milliseconds that a state can have: no step is longer, whatever it
// counts.
constexpr double kLongestStepMs = 1000;

}  // namespace

void StepBudget::composing_took(double milliseconds) {
    compose_ms_.add(milliseconds);
}

void StepBudget::begin_step(double lighting_ms) {
    lighting_ms_.add(lighting_ms);
    light_is_new_ = true;
    spent_ms_ = 0;
    spent_columns_ = 0;
}

void StepBudget::slice_took(double milliseconds, std::uint32_t columns) {
    light_is_new_ = false;
    spent_ms_ += milliseconds;
    spent_columns_ += columns;
}

relighting::Budget StepBudget::for_step(const relighting::Budget& budget,
                                        std::size_t images) const {
    relighting::Budget step = budget;
    if (step.milliseconds) {
        // All of them are lit, composed and encoded on the same threads.
        const double rounds = std::max(
            1.0, static_cast<double>(images) / tbb::this_task_arena::max_concurrency());
        const double taken = rounds * (compose_ms_.mean() + overhead_ms_ +
                                       (light_is_new_ ? lighting_ms_.mean() : 0));
        step.milliseconds =
            std::max(kLeastPart * *step.milliseconds, *step.milliseconds - taken);
    }
    return step;
}

bool StepBudget::is_spent(const relighting::Budget& budget) const {
    if (budget.coefficients) {
        return spent_columns_ >= *budget.coefficients || spent_ms_ >= kLongestStepMs;
    }
    const double whole = for_step(budget, 1).milliseconds.value_or(0);
    return spent_ms_ > 0 &&
           (whole <= ceiling_ms_ || whole - spent_ms_ < kLeastSlice * ceiling_ms_);
}

relighting::Budget StepBudget::for_slice(const relighting::Budget& budget,
                                         std::size_t images) const {
    relighting::Budget slice = for_step(budget, images);
    if (slice.coefficients && spent_columns_ < *slice.coefficients) {
        *slice.coefficients -= spent_columns_;
    }
    if (slice.milliseconds && spent_ms_ < *slice.milliseconds) {
        *slice.milliseconds -= spent_ms_;
    }
    return slice;
}

}  // namespace relume::net
