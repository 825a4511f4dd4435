// How far something is that takes a while: one line on standard error, for people.
#pragma once

#include <chrono>
#include <string>

namespace relume::cli {

class Progress {
  public:
    // Speaks where standard error is a terminal, or `always`: there on one line that is drawn
    // anew, elsewhere line by line.
    explicit Progress(bool always);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;
    ~Progress();  // ends the line

    [[nodiscard]] bool is_silent() const { return !terminal_ && !always_; }
    // Not thread-safe. Some times a second on a terminal, else every other second.
    void update(const std::string& text);

  private:
    using Clock = std::chrono::steady_clock;

    bool terminal_;
    bool always_;
    bool drawn_ = false;
    Clock::time_point next_{};
};

}  // namespace relume::cli
