// What an image costs, measured while it runs: so much per byte of columns touched, and the
// rest.
#pragma once

#include <cstdint>

namespace relume::engine {

// Exponential averages of the last images; starts from a cautious guess. Not thread-safe.
class CostModel {
  public:
    void record_columns(std::uint64_t bytes, double milliseconds);
    void record_overhead(double milliseconds);

    // Bytes of columns that fit beside the overhead into so many milliseconds.
    [[nodiscard]] std::uint64_t bytes_within(double milliseconds) const;

  private:
    double nanoseconds_per_byte_ = 1;
    double overhead_milliseconds_ = 0;
};

}  // namespace relume::engine
