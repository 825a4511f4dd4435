// Follows the folder of scenes while the server runs.
#pragma once

#include "server/net/base/clock.h"
#include "server/net/library/scene_library.h"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

namespace relume::net {

// A thread of its own opens scenes: it takes seconds, and a part of the processors only, so
// that rooms go on meanwhile. Looks at the folder from time to time rather than being told by
// the system, for network file systems tell nobody.
class SceneWatcher {
  public:
    struct Options {
        std::filesystem::path folder;
        // Between two looks; 0: none but those asked for.
        std::chrono::milliseconds interval{1000};
    };
    // `started` is called once, after the first refresh; `changed` after each later one that
    // changed what is offered. Both by the watcher's thread.
    SceneWatcher(SceneLibrary& scenes,
                 Options options,
                 std::function<void()> started,
                 std::function<void()> changed);
    SceneWatcher(const SceneWatcher&) = delete;
    SceneWatcher& operator=(const SceneWatcher&) = delete;
    // Waits for a scene that is being opened.
    ~SceneWatcher();

    // Looks again now, without waiting for changes to settle; from any thread.
    void look_now();

  private:
    void watch();
    void refresh(SceneLibrary::Patience patience);

    SceneLibrary& scenes_;
    const Options options_;
    const std::function<void()> started_;
    const std::function<void()> changed_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool asked_ = false;
    bool stopping_ = false;
    bool folder_is_readable_ = true;  // at the last look
    std::jthread thread_;
};

}  // namespace relume::net
