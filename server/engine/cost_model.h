// What an image costs: some time for every byte of its columns, and an overhead. Both are
// measured while images are made.
#pragma once

#include "protocol/base/timing/running_mean.h"

#include <cstddef>
#include <cstdint>

namespace relume::engine {

// Exponential averages of the last images; a cautious guess before the first. Not thread-safe.
class CostModel {
  public:
    void record_columns(std::uint64_t bytes, double milliseconds);
    void record_overhead(double milliseconds);

    // Bytes of columns that one of so many sessions can take when all of them together have
    // `milliseconds`, overheads included, on the threads of the caller's arena.
    [[nodiscard]] std::uint64_t bytes_within(double milliseconds, std::size_t sessions) const;

  private:
    bool measured_ = false;
    timing::RunningMean nanoseconds_per_byte_{1};
    timing::RunningMean overhead_milliseconds_;
};

}  // namespace relume::engine
