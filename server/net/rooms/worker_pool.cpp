#include "server/net/rooms/worker_pool.h"

#include <algorithm>
#include <utility>

namespace relume::net {

namespace {

// An item that took more than its part while nobody else wanted it is not held to that for
// longer.
constexpr std::chrono::milliseconds kLargestDebt{500};

}  // namespace

void WorkAccount::charge(Clock::time_point begin,
                         Clock::duration taken,
                         std::size_t competitors) {
    const auto whole = taken * static_cast<Clock::duration::rep>(competitors);
    paid_until_ = std::min(std::max(paid_until_, begin) + whole, begin + taken + kLargestDebt);
}

WorkerPool::WorkerPool(std::size_t threads, LargestBatch largest_batch)
    : largest_batch_(largest_batch) {
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
    insert_locked(std::move(item), priority, deadline);
}

void WorkerPool::insert_locked(std::shared_ptr<WorkItem> item,
                               WorkPriority priority,
                               Clock::time_point deadline) {
    const Clock::time_point place = std::max(deadline, item->account_.paid_until());
    const auto at = std::upper_bound(
        queue_.begin(), queue_.end(), place,
        [](Clock::time_point time, const Waiting& other) { return time < other.place; });
    queue_.insert(
        at,
        {.deadline = deadline, .place = place, .priority = priority, .item = std::move(item)});
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
    const void* const key = queue_.front().item->batch_key();
    const std::size_t largest =
        priority == WorkPriority::edit ? largest_batch_.edits : largest_batch_.refinements;
    std::erase_if(queue_, [&](Waiting& waiting) {
        const bool taken =
            next.empty() || (next.size() < largest && key != nullptr &&
                             waiting.priority == priority && waiting.item->batch_key() == key);
        if (taken) {
            next.push_back(std::move(waiting.item));
        }
        return taken;
    });
    return next;
}

void WorkerPool::charge_locked(std::span<const std::shared_ptr<WorkItem>> items,
                               Clock::time_point begin,
                               Clock::duration taken) {
    const auto is_one_of_them = [&items](const Waiting& waiting) {
        return std::find(items.begin(), items.end(), waiting.item) != items.end();
    };
    std::vector<Waiting> again;  // queued while they ran, before this was known
    for (const Waiting& waiting : queue_) {
        if (is_one_of_them(waiting)) {
            again.push_back(waiting);
        }
    }
    std::erase_if(queue_, is_one_of_them);
    const auto each = taken / static_cast<Clock::duration::rep>(items.size());
    for (const std::shared_ptr<WorkItem>& item : items) {
        item->account_.charge(begin, each, running_ + queue_.size());
    }
    for (Waiting& waiting : again) {
        insert_locked(std::move(waiting.item), waiting.priority, waiting.deadline);
    }
}

void WorkerPool::work() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        release_due_locked(Clock::now());
        if (auto items = next_locked(); !items.empty()) {
            running_ += items.size();
            lock.unlock();
            const Clock::time_point begin = Clock::now();
            items.front()->run(std::span(items).subspan(1));
            const Clock::duration taken = Clock::now() - begin;
            lock.lock();
            charge_locked(items, begin, taken);
            running_ -= items.size();
            lock.unlock();
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
