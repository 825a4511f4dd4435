// How far a bake is: a bar with rate and time left on a terminal, plain lines otherwise.
#pragma once

#include "precompute/bake/bake.h"

#include <chrono>
#include <cstdio>
#include <string>

namespace relume::bake {

// "42%  310 pixels/s  1.2 Mrays/s  1:04 gone  1:29 left" after so many seconds of a stage; of
// the visibility of points it begins with "visibility". The time left
// is named once a tenth of what had to be baked is baked, for before that it would be a guess.
[[nodiscard]] std::string progress_text(const BakeProgress& progress, double seconds);

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
    BakeStage stage_ = BakeStage::rows;
    Clock::time_point start_ = Clock::now();  // of the stage
    Clock::time_point next_ = start_;
};

}  // namespace relume::bake
