// Looks at folders from time to time while the server runs.
#pragma once

#include "server/net/library/followed_folder.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace relume::net {

// A thread of its own looks, and opens what it finds. That takes seconds. After the first look
// it uses only some of the processors, so that rooms go on meanwhile. It looks and does not
// wait for notices of the system, because network file systems send none.
class FolderWatcher {
  public:
    // What is done at each look. Has to return soon when a stop is asked for.
    using Look = std::function<void(Patience patience, const std::stop_token& stop)>;

    // Looks at once, and then after each interval; 0: only when asked to.
    FolderWatcher(std::chrono::milliseconds interval, Look look);
    FolderWatcher(const FolderWatcher&) = delete;
    FolderWatcher& operator=(const FolderWatcher&) = delete;
    // Stops, and waits for a look under way.
    ~FolderWatcher();

    // Looks again now, without waiting for changes to settle; from any thread.
    void look_now();
    // Asks the thread to end, and does not wait for it.
    void stop();
    // A look is under way.
    [[nodiscard]] bool is_looking() const { return is_looking_.load(); }

  private:
    void watch(const std::stop_token& stop);

    const std::chrono::milliseconds interval_;
    const Look look_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    bool is_asked_ = false;
    std::atomic<bool> is_looking_{true};
    std::jthread thread_;
};

}  // namespace relume::net
