#include "server/net/library/folder_watcher.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace relume::net {

namespace {

// Of the processors, for what is opened while rooms are served.
constexpr int kPartOfProcessors = 4;

}  // namespace

FolderWatcher::FolderWatcher(std::chrono::milliseconds interval, Look look)
    : interval_(interval),
      look_(std::move(look)),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

FolderWatcher::~FolderWatcher() = default;

void FolderWatcher::look_now() {
    {
        const std::lock_guard lock(mutex_);
        is_asked_ = true;
    }
    wake_.notify_all();
}

void FolderWatcher::stop() {
    thread_.request_stop();
}

void FolderWatcher::watch(const std::stop_token& stop) {
    look_(Patience::none, stop);
    is_looking_ = false;
    tbb::task_arena arena(
        std::max(1, tbb::this_task_arena::max_concurrency() / kPartOfProcessors));
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        const auto is_asked = [this] { return is_asked_; };
        if (interval_.count() > 0) {
            wake_.wait_for(lock, stop, interval_, is_asked);
        } else {
            wake_.wait(lock, stop, is_asked);
        }
        if (stop.stop_requested()) {
            return;
        }
        const Patience patience =
            std::exchange(is_asked_, false) ? Patience::none : Patience::until_settled;
        lock.unlock();
        is_looking_ = true;
        arena.execute([&] { look_(patience, stop); });
        is_looking_ = false;
        lock.lock();
    }
}

}  // namespace relume::net
