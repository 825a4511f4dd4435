// The threads that relight and encode, so that those that serve sockets never wait for them.
#pragma once

#include "server/net/base/clock.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace relume::net {

// The time until which an item has used up its part of the workers, if every item that competes
// has an equal part. The pool keeps it.
class WorkAccount {
  public:
    // The item has run for `taken`, from `begin` on, while so many items competed.
    void charge(Clock::time_point begin, Clock::duration taken, std::size_t competitors);
    [[nodiscard]] Clock::time_point paid_until() const { return paid_until_; }

  private:
    Clock::time_point paid_until_{};
};

// What a worker runs, one slice at a time. An item queues itself again if more is left to do.
class WorkItem {
  public:
    WorkItem() = default;
    WorkItem(const WorkItem&) = delete;
    WorkItem& operator=(const WorkItem&) = delete;
    virtual ~WorkItem() = default;

    // Items of equal keys may run together, as one batch. An item whose key is null runs alone.
    [[nodiscard]] virtual const void* batch_key() const noexcept { return nullptr; }
    // Runs one slice, of this item and of `others`: items of its key that were waiting too, and
    // have left the queue with it.
    virtual void run(std::span<const std::shared_ptr<WorkItem>> others) noexcept = 0;

  private:
    friend class WorkerPool;
    WorkAccount account_;
};

// Edits that someone waits for go before images that merely get better.
enum class WorkPriority : std::uint8_t { edit, refinement };

// Thread-safe.
//
// The queue is in the order of deadlines. The deadline of an edit is the moment it was read;
// that of a refinement lies kRefinementPatience after it was queued. So edits go first, and no
// refinement starves. An item never stands earlier than its account allows: one that takes long
// slices comes less often, and one that takes short slices waits only for those that run. Each
// item is in the queue at most once, so the queue is never longer than there are items. While
// nothing is queued no thread wakes.
class WorkerPool {
  public:
    // A refinement waits no longer than this for the edits before it.
    static constexpr std::chrono::milliseconds kRefinementPatience{100};

    // How many items of one key, all of one priority, are taken off the queue together at most.
    struct LargestBatch {
        std::size_t edits = 1;
        std::size_t refinements = 1;
    };
    WorkerPool(std::size_t threads, LargestBatch largest_batch);
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    // As `stop`.
    ~WorkerPool();

    // Queues the item, or moves it forward if it waits with a later deadline.
    void enqueue(std::shared_ptr<WorkItem> item,
                 WorkPriority priority,
                 Clock::time_point since = Clock::now());
    // Queues the item after a while; replaces an earlier delay of the same item.
    void enqueue_after(std::shared_ptr<WorkItem> item,
                       WorkPriority priority,
                       Clock::duration delay);
    // Forgets what is queued, waits for what runs. Items queued afterwards are dropped.
    void stop();

  private:
    struct Waiting {
        Clock::time_point deadline;  // as it was asked for
        Clock::time_point place;     // in the queue: no earlier than the account is paid
        WorkPriority priority;
        std::shared_ptr<WorkItem> item;
    };
    struct Delayed {
        Clock::time_point due;
        WorkPriority priority;
        std::shared_ptr<WorkItem> item;
    };

    void work();
    void enqueue_locked(std::shared_ptr<WorkItem> item,
                        WorkPriority priority,
                        Clock::time_point since);
    void insert_locked(std::shared_ptr<WorkItem> item,
                       WorkPriority priority,
                       Clock::time_point deadline);
    void release_due_locked(Clock::time_point now);
    // Items that have run together for so long.
    void charge_locked(std::span<const std::shared_ptr<WorkItem>> items,
                       Clock::time_point begin,
                       Clock::duration taken);
    // The first of the queue, and who may go with it; nothing when it is empty.
    [[nodiscard]] std::vector<std::shared_ptr<WorkItem>> next_locked();

    const LargestBatch largest_batch_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<Waiting> queue_;  // by place; of equals the earlier queued first
    std::vector<Delayed> delayed_;
    std::size_t running_ = 0;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace relume::net
