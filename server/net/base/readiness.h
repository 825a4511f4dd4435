// Whether the server takes edits now.
#pragma once

#include <atomic>
#include <stop_token>

namespace relume::net {

// Thread-safe.
class Readiness {
  public:
    enum class Phase { starting, ready, draining };

    [[nodiscard]] Phase phase() const { return phase_.load(); }
    [[nodiscard]] bool ready() const { return phase() == Phase::ready; }
    // Never back from draining.
    void set_ready() {
        Phase starting = Phase::starting;
        phase_.compare_exchange_strong(starting, Phase::ready);
        phase_.notify_all();
    }
    void set_draining() {
        phase_.store(Phase::draining);
        phase_.notify_all();
        draining_.request_stop();
    }
    // For those who wait and need not once the server drains. Their callbacks run in the thread
    // that calls `set_draining`.
    [[nodiscard]] std::stop_token draining() const { return draining_.get_token(); }
    void wait_until_started() const { phase_.wait(Phase::starting); }

  private:
    std::atomic<Phase> phase_{Phase::starting};
    std::stop_source draining_;
};

}  // namespace relume::net
