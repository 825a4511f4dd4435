#include "server/net/worker_pool.h"

#include <algorithm>
#include <utility>

namespace relume::net {

WorkerPool::WorkerPool(std::size_t threads, LargestCompany largest_company)
    : largest_company_(largest_company) {
    threads_.reserve(threads);
    for (std::size_t i = 0; i < threads; ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

WorkerPool::~WorkerPool() {
    stop();
}

void WorkerPool::enqueue(std::shared_ptr<WorkItem> item,
                         WorkPriority priority,
                         Clock::time_point since) {
    {
        const std::lock_guard lock(mutex_);
        enqueue_locked(std::move(item), priority, since);
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
    std::vector<Waiting> queue;
    std::vector<Delayed> delayed;
    const std::lock_guard lock(mutex_);
    queue.swap(queue_);
    delayed.swap(delayed_);
}

void WorkerPool::enqueue_locked(std::shared_ptr<WorkItem> item,
                                WorkPriority priority,
                                Clock::time_point since) {
    if (stopping_) {
        return;
    }
    const bool patient = priority == WorkPriority::refinement;
    const Clock::time_point deadline = patient ? since + kRefinementPatience : since;
    const auto waiting = std::find_if(queue_.begin(), queue_.end(),
                                      [&](const Waiting& other) { return other.item == item; });
    if (waiting != queue_.end()) {
        if (waiting->deadline <= deadline) {
            return;
        }
        queue_.erase(waiting);
    }
    const auto place = std::upper_bound(
        queue_.begin(), queue_.end(), deadline,
        [](Clock::time_point time, const Waiting& other) { return time < other.deadline; });
    queue_.insert(place, {.deadline = deadline, .priority = priority, .item = std::move(item)});
}

void WorkerPool::release_due_locked(Clock::time_point now) {
    std::erase_if(delayed_, [&](Delayed& delayed) {
        if (delayed.due > now) {
            return false;
        }
        enqueue_locked(std::move(delayed.item), delayed.priority, delayed.due);
        return true;
    });
}

std::vector<std::shared_ptr<WorkItem>> WorkerPool::next_locked() {
    std::vector<std::shared_ptr<WorkItem>> next;
    if (queue_.empty()) {
        return next;
    }
    const WorkPriority priority = queue_.front().priority;
    const void* const company = queue_.front().item->company();
    const std::size_t largest =
        priority == WorkPriority::edit ? largest_company_.edits : largest_company_.refinements;
    std::erase_if(queue_, [&](Waiting& waiting) {
        const bool taken = next.empty() ||
                           (next.size() < largest && company != nullptr &&
                            waiting.priority == priority && waiting.item->company() == company);
        if (taken) {
            next.push_back(std::move(waiting.item));
        }
        return taken;
    });
    return next;
}

void WorkerPool::work() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        release_due_locked(Clock::now());
        if (auto items = next_locked(); !items.empty()) {
            lock.unlock();
            items.front()->run(std::span(items).subspan(1));
            items.clear();
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
