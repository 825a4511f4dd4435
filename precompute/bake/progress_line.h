// How far a bake is: a bar with rate and time left on a terminal, plain lines otherwise.
#pragma once

#include "precompute/bake/bake.h"

#include <chrono>
#include <cstdio>

namespace relume::bake {

class ProgressLine {
  public:
    // Writes to `stream`, which outlives it; a bar where it is a terminal.
    explicit ProgressLine(std::FILE* stream);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    // Ends the bar's line.
    ~ProgressLine();

    // Not thread-safe. Draws some times a second on a terminal, else now and then.
    void update(const BakeProgress& progress);

  private:
    using Clock = std::chrono::steady_clock;

    std::FILE* stream_;
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point next_ = start_;
};

}  // namespace relume::bake
