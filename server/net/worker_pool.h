// The threads that relight and encode, so that those that serve sockets never wait for them.
#pragma once

#include "server/net/clock.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace relume::net {

// What a worker runs, one short slice at a time; it queues itself again if more is left.
class WorkItem {
  public:
    WorkItem() = default;
    WorkItem(const WorkItem&) = delete;
    WorkItem& operator=(const WorkItem&) = delete;
    virtual ~WorkItem() = default;
    virtual void run() noexcept = 0;
};

// Edits that someone waits for go before images that merely get better.
enum class WorkPriority : std::uint8_t { edit, refinement };

// Thread-safe. An item is in the queue at most once, so the queue is never longer than there
// are items. With nothing queued no thread wakes.
class WorkerPool {
  public:
    explicit WorkerPool(std::size_t threads);
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    // As `stop`.
    ~WorkerPool();

    // Queues the item, or promotes it if it waits with less priority.
    void enqueue(std::shared_ptr<WorkItem> item, WorkPriority priority);
    // Queues the item after a while; replaces an earlier delay of the same item.
    void enqueue_after(std::shared_ptr<WorkItem> item,
                       WorkPriority priority,
                       Clock::duration delay);
    // Forgets what is queued, waits for what runs. Items queued afterwards are dropped.
    void stop();

  private:
    using Queue = std::deque<std::shared_ptr<WorkItem>>;
    struct Delayed {
        Clock::time_point due;
        WorkPriority priority;
        std::shared_ptr<WorkItem> item;
    };

    void work();
    void enqueue_locked(std::shared_ptr<WorkItem> item, WorkPriority priority);
    void release_due_locked(Clock::time_point now);
    [[nodiscard]] std::shared_ptr<WorkItem> next_locked();

    std::mutex mutex_;
    std::condition_variable wake_;
    Queue edits_;
    Queue refinements_;
    std::vector<Delayed> delayed_;
    std::size_t edits_in_a_row_ = 0;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace relume::net
