// How much of an image's time is for relighting, and how much of that its slices have spent.
#pragma once

#include "protocol/base/timing/running_mean.h"
#include "protocol/relighting/budget.h"

#include <cstddef>
#include <cstdint>

namespace relume::net {

// A budget in milliseconds is for the whole way from edit to encoded picture. What lighting,
// composing, waiting and encoding take of it on average is not for relighting. Not thread-safe.
class StepBudget {
  public:
    // `ceiling_ms`: the longest that a slice relights.
    explicit StepBudget(double ceiling_ms) : ceiling_ms_(ceiling_ms) {}

    // A measured time, of which a running mean is kept.
    void composing_took(double milliseconds);
    // The milliseconds of an image that are neither lighting nor relighting nor composing:
    // waiting for a worker, being encoded.
    void set_overhead(double milliseconds) { overhead_ms_ = milliseconds; }

    // A step of new light begins, which it took `lighting_ms` to make.
    void begin_step(double lighting_ms);
    // A slice of the step has relit for so long and added so many columns.
    void slice_took(double milliseconds, std::uint32_t columns);

    // Whether what the step has left of the budget is too little for another slice.
    [[nodiscard]] bool is_spent(const relighting::Budget& budget) const;
    // The budget of the next slice of an image that is made together with others, `images` in
    // all: what the step has left, or, where it has nothing left, the whole budget again.
    [[nodiscard]] relighting::Budget for_slice(const relighting::Budget& budget,
                                               std::size_t images) const;
    // The longest that a slice relights.
    [[nodiscard]] double ceiling_ms() const { return ceiling_ms_; }
    // The mean of what it has taken to make new light.
    [[nodiscard]] double lighting_ms() const { return lighting_ms_.mean(); }

  private:
    // The budget of the step, before any of it is spent.
    [[nodiscard]] relighting::Budget for_step(const relighting::Budget& budget,
                                              std::size_t images) const;

    const double ceiling_ms_;
    timing::RunningMean lighting_ms_;
    timing::RunningMean compose_ms_;
    double overhead_ms_ = 0;
    bool light_is_new_ = false;  // no slice of the step has run
    double spent_ms_ = 0;
    std::uint32_t spent_columns_ = 0;
};

}  // namespace relume::net
