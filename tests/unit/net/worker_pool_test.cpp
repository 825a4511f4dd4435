#include "server/net/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <latch>
#include <mutex>
#include <string>

namespace relume::net {
namespace {

class Item : public WorkItem {
  public:
    explicit Item(std::function<void()> work) : work_(std::move(work)) {}
    void run() noexcept override { work_(); }

  private:
    std::function<void()> work_;
};

std::shared_ptr<WorkItem> item(std::function<void()> work) {
    return std::make_shared<Item>(std::move(work));
}

// Holds the only worker until released, so that what is queued meanwhile waits.
class Gate {
  public:
    explicit Gate(WorkerPool& pool) {
        pool.enqueue(item([this] {
                         entered_.count_down();
                         open_.wait();
                     }),
                     WorkPriority::edit);
        entered_.wait();
    }
    void open() { open_.count_down(); }

  private:
    std::latch entered_{1};
    std::latch open_{1};
};

class Order {
  public:
    std::shared_ptr<WorkItem> add(char name) {
        return item([this, name] {
            const std::lock_guard lock(mutex_);
            order_.push_back(name);
        });
    }
    std::string text() {
        const std::lock_guard lock(mutex_);
        return order_;
    }

  private:
    std::mutex mutex_;
    std::string order_;
};

void finish(WorkerPool& pool) {
    std::promise<void> done;
    pool.enqueue(item([&done] { done.set_value(); }), WorkPriority::refinement);
    done.get_future().wait();
}

TEST(WorkerPool, EditsGoBeforeRefinementsEachInOrder) {
    Order order;  // outlives what the pool still runs
    WorkerPool pool(1);
    Gate gate(pool);
    pool.enqueue(order.add('a'), WorkPriority::refinement);
    pool.enqueue(order.add('b'), WorkPriority::edit);
    pool.enqueue(order.add('c'), WorkPriority::refinement);
    pool.enqueue(order.add('d'), WorkPriority::edit);
    gate.open();
    finish(pool);
    EXPECT_EQ(order.text(), "bdac");
}

TEST(WorkerPool, AnItemIsQueuedOnceAndPromoted) {
    Order order;  // outlives what the pool still runs
    WorkerPool pool(1);
    Gate gate(pool);
    const auto first = order.add('a');
    const auto second = order.add('b');
    pool.enqueue(first, WorkPriority::refinement);
    pool.enqueue(second, WorkPriority::refinement);
    pool.enqueue(second, WorkPriority::edit);
    pool.enqueue(second, WorkPriority::refinement);
    pool.enqueue(second, WorkPriority::edit);
    gate.open();
    finish(pool);
    EXPECT_EQ(order.text(), "ba");
}

TEST(WorkerPool, EditsDoNotStarveARefinement) {
    Order order;  // outlives what the pool still runs
    WorkerPool pool(1);
    Gate gate(pool);
    for (int i = 0; i < 40; ++i) {
        pool.enqueue(order.add('e'), WorkPriority::edit);
    }
    pool.enqueue(order.add('r'), WorkPriority::refinement);
    gate.open();
    finish(pool);
    EXPECT_LT(order.text().find('r'), 10U);
}

TEST(WorkerPool, DelayedItemsRunAndAreReplaced) {
    WorkerPool pool(1);
    std::atomic<int> runs{0};
    std::promise<void> last;
    const auto counted = item([&runs] { ++runs; });
    pool.enqueue_after(counted, WorkPriority::edit, std::chrono::milliseconds(5));
    pool.enqueue_after(counted, WorkPriority::edit, std::chrono::milliseconds(10));
    pool.enqueue_after(item([&last] { last.set_value(); }), WorkPriority::refinement,
                       std::chrono::milliseconds(20));
    last.get_future().wait();
    EXPECT_EQ(runs.load(), 1);
}

TEST(WorkerPool, StopForgetsWhatWaits) {
    std::atomic<int> runs{0};
    WorkerPool pool(1);
    pool.enqueue_after(item([&runs] { ++runs; }), WorkPriority::edit, std::chrono::hours(1));
    pool.stop();
    pool.enqueue(item([&runs] { ++runs; }), WorkPriority::edit);
    EXPECT_EQ(runs.load(), 0);
}

}  // namespace
}  // namespace relume::net
