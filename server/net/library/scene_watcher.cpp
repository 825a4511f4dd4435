#include "server/net/library/scene_watcher.h"

#include <spdlog/spdlog.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace relume::net {

namespace {

// Of the processors, for scenes that are opened while rooms are served.
constexpr int kShareOfProcessors = 4;

}  // namespace

SceneWatcher::SceneWatcher(SceneLibrary& scenes,
                           Options options,
                           std::function<void()> started,
                           std::function<void()> changed)
    : scenes_(scenes),
      options_(std::move(options)),
      started_(std::move(started)),
      changed_(std::move(changed)),
      thread_([this] { watch(); }) {}

SceneWatcher::~SceneWatcher() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
}

void SceneWatcher::look_now() {
    {
        const std::lock_guard lock(mutex_);
        asked_ = true;
    }
    wake_.notify_all();
}

void SceneWatcher::watch() {
    refresh(SceneLibrary::Patience::none);
    started_();
    tbb::task_arena arena(
        std::max(1, tbb::this_task_arena::max_concurrency() / kShareOfProcessors));
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        const auto is_called = [this] { return asked_ || stopping_; };
        if (options_.interval.count() > 0) {
            wake_.wait_for(lock, options_.interval, is_called);
        } else {
            wake_.wait(lock, is_called);
        }
        if (stopping_) {
            return;
        }
        const auto patience = std::exchange(asked_, false)
                                  ? SceneLibrary::Patience::none
                                  : SceneLibrary::Patience::until_settled;
        lock.unlock();
        arena.execute([&] { refresh(patience); });
        lock.lock();
    }
}

void SceneWatcher::refresh(SceneLibrary::Patience patience) {
    try {
        const bool changed = scenes_.refresh(options_.folder, patience);
        folder_is_readable_ = true;
        if (changed) {
            changed_();
        }
    } catch (const std::exception& failure) {
        if (std::exchange(folder_is_readable_, false)) {
            spdlog::error("scenes_unreadable reason={:?}", failure.what());
        }
    }
}

}  // namespace relume::net
