// How far a command is, for people: on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace relume::lab {

// A line that is drawn over on a terminal, a line every ten seconds elsewhere. Not thread-safe.
class Progress {
  public:
    // `what` names one of the things counted: "image".
    Progress(std::string what, std::size_t total);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;
    // Ends the line.
    ~Progress();

    // "image 12 of 150, 9 s left"; `note` is put in front where it is not empty.
    void update(std::size_t done, const std::string& note = {});

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    std::size_t total_;
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point next_ = start_;
};

}  // namespace relume::lab
