#include "server/net/worker_pool.h"

#include <algorithm>
#include <utility>

namespace relume::net {

namespace {

// Of so many slices one goes to a refinement that waits, however many edits come.
constexpr std::size_t kEditsPerRefinement = 8;

}  // namespace

WorkerPool::WorkerPool(std::size_t threads) {
    threads_.reserve(threads);
    for (std::size_t i = 0; i < threads; ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

WorkerPool::~WorkerPool() {
    stop();
}

void WorkerPool::enqueue(std::shared_ptr<WorkItem> item, WorkPriority priority) {
    {
        const std::lock_guard lock(mutex_);
        enqueue_locked(std::move(item), priority);
    }
    wake_.notify_one();
}

void WorkerPool::enqueue_after(std::shared_ptr<WorkItem> item,
                               WorkPriority priority,
                               Clock::duration delay) {
    {
        const std::lock_guard lock(mutex_);
        if (stopping_) {
            return;
        }
        std::erase_if(delayed_, [&](const Delayed& other) { return other.item == item; });
        delayed_.push_back(
            {.due = Clock::now() + delay, .priority = priority, .item = std::move(item)});
    }
    wake_.notify_one();
}

void WorkerPool::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    threads_.clear();
    // Items may own the last reference to what owns them: let go of them without the lock.
    Queue edits;
    Queue refinements;
    std::vector<Delayed> delayed;
    const std::lock_guard lock(mutex_);
    edits.swap(edits_);
    refinements.swap(refinements_);
    delayed.swap(delayed_);
}

void WorkerPool::enqueue_locked(std::shared_ptr<WorkItem> item, WorkPriority priority) {
    if (stopping_ || std::find(edits_.begin(), edits_.end(), item) != edits_.end()) {
        return;
    }
    const auto waiting = std::find(refinements_.begin(), refinements_.end(), item);
    if (priority == WorkPriority::refinement) {
        if (waiting == refinements_.end()) {
            refinements_.push_back(std::move(item));
        }
        return;
    }
    if (waiting != refinements_.end()) {
        refinements_.erase(waiting);
    }
    edits_.push_back(std::move(item));
}

void WorkerPool::release_due_locked(Clock::time_point now) {
    std::erase_if(delayed_, [&](Delayed& delayed) {
        if (delayed.due > now) {
            return false;
        }
        enqueue_locked(std::move(delayed.item), delayed.priority);
        return true;
    });
}

std::shared_ptr<WorkItem> WorkerPool::next_locked() {
    const bool refine =
        edits_.empty() || (!refinements_.empty() && edits_in_a_row_ >= kEditsPerRefinement);
    Queue& queue = refine ? refinements_ : edits_;
    if (queue.empty()) {
        return nullptr;
    }
    edits_in_a_row_ = refine ? 0 : edits_in_a_row_ + 1;
    std::shared_ptr<WorkItem> item = std::move(queue.front());
    queue.pop_front();
    return item;
}

void WorkerPool::work() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        release_due_locked(Clock::now());
        if (std::shared_ptr<WorkItem> item = next_locked()) {
            lock.unlock();
            item->run();
            item.reset();
            lock.lock();
        } else if (delayed_.empty()) {
            wake_.wait(lock);
        } else {
            const auto soonest = std::min_element(
                delayed_.begin(), delayed_.end(),
                [](const Delayed& a, const Delayed& b) { return a.due < b.due; });
            const Clock::time_point due = soonest->due;
            wake_.wait_until(lock, due);
        }
    }
}

}  // namespace relume::net
