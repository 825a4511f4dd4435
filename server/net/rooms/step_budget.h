// What of an image's time is left for relighting it, and what its slices have spent of that.
#pragma once

#include "protocol/relighting/budget.h"

#include <cstddef>
#include <cstdint>

namespace relume::net {

// A budget in milliseconds is for the whole way from edit to encoded picture: what lighting,
// composing and waiting have been taking is not for relighting. Not thread-safe.
class StepBudget {
  public:
    // `ceiling_ms`: the longest that a slice relights.
    explicit StepBudget(double ceiling_ms) : ceiling_ms_(ceiling_ms) {}

    // What has been measured; running means are kept of it.
    void composing_took(double milliseconds);
    // Of an image besides lighting, relighting and composing: to wait for a thread, to be
    // encoded.
    void set_beside(double milliseconds) { beside_ms_ = milliseconds; }

    // A step begins, for new light, which it took so long to make.
    void begin_step(double lighting_ms);
    // A slice of it has relit for so long.
    void slice_took(double milliseconds, std::uint32_t columns);

    // The step has nothing left of the budget that a slice would be worth.
    [[nodiscard]] bool is_spent(const relighting::Budget& budget) const;
    // For the next slice of one of so many images that are made together: what the step has
    // left, or all of the budget again where it has nothing left.
    [[nodiscard]] relighting::Budget for_slice(const relighting::Budget& budget,
                                               std::size_t images) const;
    // Of a slice, in milliseconds.
    [[nodiscard]] double ceiling_ms() const { return ceiling_ms_; }
    // The mean of what it has taken to make new light.
    [[nodiscard]] double lighting_ms() const { return lighting_ms_; }

  private:
    // The step's, before any of it is spent.
    [[nodiscard]] relighting::Budget for_step(const relighting::Budget& budget,
                                              std::size_t images) const;

    const double ceiling_ms_;
    double lighting_ms_ = 0;
    double compose_ms_ = 0;
    double beside_ms_ = 0;
    bool light_is_new_ = false;  // no slice of the step has run
    double spent_ms_ = 0;
    std::uint32_t spent_columns_ = 0;
};

}  // namespace relume::net
