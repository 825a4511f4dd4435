// How long edits take to show: from sending an edit to receiving the first image whose revision
// is at least the edit's.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <vector>

namespace relume::cli {

using Clock = std::chrono::steady_clock;

// Ids ascend. A change names the last of the edits it holds, and so answers all before it too.
class EditClock {
  public:
    void edit_sent(std::uint64_t id, Clock::time_point when);
    void edit_refused(std::uint64_t id);
    void change_received(std::uint64_t edit_id, std::uint64_t revision);

    // Milliseconds of each edit that this image is the first to show, oldest edit first.
    [[nodiscard]] std::vector<double> image_received(std::uint64_t revision,
                                                     Clock::time_point when);

  private:
    struct Pending {
        std::uint64_t id;
        Clock::time_point sent;
        std::uint64_t revision;  // 0 until its change came
    };
    std::deque<Pending> pending_;
};

}  // namespace relume::cli
