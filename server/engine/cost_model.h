// What an image costs, measured while it runs: so much per byte of columns touched, and the
// rest.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::engine {

// Exponential averages of the last images; a cautious guess before the first. Not thread-safe.
class CostModel {
  public:
    void record_columns(std::uint64_t bytes, double milliseconds);
    void record_overhead(double milliseconds);

    // Bytes of columns that fit beside the overhead into a session's share of so many
    // milliseconds, in which several sessions do the same on the threads of the caller's arena.
    [[nodiscard]] std::uint64_t bytes_within(double milliseconds, std::size_t sessions) const;

  private:
    bool measured_ = false;
    double nanoseconds_per_byte_ = 1;
    double overhead_milliseconds_ = 0;
};

}  // namespace relume::engine
