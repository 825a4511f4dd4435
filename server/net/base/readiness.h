// Whether the server takes edits now.
#pragma once

#include <atomic>

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
    }
    void wait_until_started() const { phase_.wait(Phase::starting); }

  private:
    std::atomic<Phase> phase_{Phase::starting};
};

}  // namespace relume::net
