// How long something takes, by a clock that never goes back.
#pragma once

#include <chrono>

namespace relume::timing {

// Runs from when it is made.
class Stopwatch {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }
    [[nodiscard]] double milliseconds() const { return 1e3 * seconds(); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace relume::timing
