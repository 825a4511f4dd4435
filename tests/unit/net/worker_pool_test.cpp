#include "server/net/rooms/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <latch>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>

namespace relume::net {
namespace {

class Item : public WorkItem {
  public:
    explicit Item(std::function<void()> work, const void* batch_key = nullptr)
        : work_(std::move(work)), batch_key_(batch_key) {}
    [[nodiscard]] const void* batch_key() const noexcept override { return batch_key_; }
    void run(std::span<const std::shared_ptr<WorkItem>> others) noexcept override {
        work_();
        for (const auto& other : others) {
            static_cast<Item&>(*other).work_();
        }
    }

  private:
    std::function<void()> work_;
    const void* batch_key_;
};

std::shared_ptr<WorkItem> item(std::function<void()> work, const void* batch_key = nullptr) {
    return std::make_shared<Item>(std::move(work), batch_key);
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
    std::shared_ptr<WorkItem> add(char name, const void* batch_key = nullptr) {
        return item(
            [this, name] {
                const std::lock_guard lock(mutex_);
                order_.push_back(name);
            },
            batch_key);
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

// The same, behind even what is due in hours.
void finish_last(WorkerPool& pool) {
    std::promise<void> done;
    pool.enqueue(item([&done] { done.set_value(); }), WorkPriority::edit,
                 Clock::now() + std::chrono::hours(2));
    done.get_future().wait();
}

TEST(WorkerPool, EditsGoBeforeRefinementsEachInOrder) {
    Order order;  // outlives what the pool still runs
    WorkerPool pool(1, {.edits = 2, .refinements = 3});
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
    WorkerPool pool(1, {.edits = 2, .refinements = 3});
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

// An edit that is read when a refinement has waited long goes after it.
TEST(WorkerPool, EditsDoNotStarveARefinement) {
    Order order;  // outlives what the pool still runs
    WorkerPool pool(1, {.edits = 2, .refinements = 3});
    Gate gate(pool);
    const Clock::time_point now = Clock::now();
    pool.enqueue(order.add('l'), WorkPriority::edit, now + 2 * WorkerPool::kRefinementPatience);
    pool.enqueue(order.add('r'), WorkPriority::refinement, now);
    pool.enqueue(order.add('e'), WorkPriority::edit, now + WorkerPool::kRefinementPatience / 2);
    gate.open();
    pool.enqueue(order.add('z'), WorkPriority::edit, now + std::chrono::hours(1));
    finish_last(pool);
    EXPECT_EQ(order.text(), "erlz");
}

// What waits behind others goes with the items of its key, if of its priority, up to the
// largest batch of edits and of refinements.
TEST(WorkerPool, ItemsOfOneKeyGoTogether) {
    Order order;  // outlives what the pool still runs
    WorkerPool pool(1, {.edits = 3, .refinements = 2});
    Gate gate(pool);
    const int one = 1;
    const int other = 2;
    pool.enqueue(order.add('a', &one), WorkPriority::edit);
    pool.enqueue(order.add('x', &other), WorkPriority::edit);
    pool.enqueue(order.add('y'), WorkPriority::edit);
    pool.enqueue(order.add('b', &one), WorkPriority::edit);
    pool.enqueue(order.add('r', &one), WorkPriority::refinement);
    pool.enqueue(order.add('c', &one), WorkPriority::edit);
    pool.enqueue(order.add('d', &one), WorkPriority::edit);
    pool.enqueue(order.add('q', &other), WorkPriority::refinement);
    pool.enqueue(order.add('s', &one), WorkPriority::refinement);
    pool.enqueue(order.add('t', &one), WorkPriority::refinement);
    gate.open();
    finish(pool);
    EXPECT_EQ(order.text(), "abcxydrsqt");
}

// As if each of two had half of the time; and whatever one has taken, it is forgiven in the
// end.
TEST(WorkAccount, IsPaidAsItsShareOfTheTimeComes) {
    using std::chrono::milliseconds;
    const Clock::time_point start = Clock::now();
    WorkAccount account;
    EXPECT_LT(account.paid_until(), start);
    account.charge(start, milliseconds(10), 1);
    EXPECT_EQ(account.paid_until(), start + milliseconds(10));
    account.charge(start + milliseconds(10), milliseconds(10), 2);
    EXPECT_EQ(account.paid_until(), start + milliseconds(30));
    account.charge(start + milliseconds(20), milliseconds(10), 2);
    EXPECT_EQ(account.paid_until(), start + milliseconds(50));
    account.charge(start + milliseconds(100), milliseconds(10), 2);
    EXPECT_EQ(account.paid_until(), start + milliseconds(120)) << "what was not taken is gone";
    account.charge(start + milliseconds(200), milliseconds(10), 1000);
    EXPECT_LE(account.paid_until(), start + milliseconds(800));
}

// Two want the worker all the time, one in long slices and one in short ones: each gets about
// half of the time, so the other gets many more slices.
TEST(WorkerPool, TimeIsSharedByCostNotByTurns) {
    class Greedy : public WorkItem, public std::enable_shared_from_this<Greedy> {
      public:
        Greedy(WorkerPool& pool, Clock::duration slice) : pool_(pool), slice_(slice) {}
        void run(std::span<const std::shared_ptr<WorkItem>> /*others*/) noexcept override {
            const Clock::time_point end = Clock::now() + slice_;
            while (Clock::now() < end) {
            }
            ++slices;
            pool_.enqueue(shared_from_this(), WorkPriority::edit, since_);
        }
        std::atomic<int> slices{0};

      private:
        WorkerPool& pool_;
        const Clock::duration slice_;
        const Clock::time_point since_ = Clock::now();  // always in a hurry
    };
    WorkerPool pool(1, {});
    const auto slow = std::make_shared<Greedy>(pool, std::chrono::milliseconds(16));
    const auto quick = std::make_shared<Greedy>(pool, std::chrono::milliseconds(1));
    pool.enqueue(slow, WorkPriority::edit);
    pool.enqueue(quick, WorkPriority::edit);
    while (slow->slices < 8) {
        std::this_thread::yield();
    }
    pool.stop();
    // Turns would be eight of each; half of the time is more than a hundred.
    EXPECT_GT(quick->slices, 4 * slow->slices);
}

TEST(WorkerPool, DelayedItemsRunAndAreReplaced) {
    WorkerPool pool(1, {.edits = 2, .refinements = 3});
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
    WorkerPool pool(1, {.edits = 2, .refinements = 3});
    pool.enqueue_after(item([&runs] { ++runs; }), WorkPriority::edit, std::chrono::hours(1));
    pool.stop();
    pool.enqueue(item([&runs] { ++runs; }), WorkPriority::edit);
    EXPECT_EQ(runs.load(), 0);
}

}  // namespace
}  // namespace relume::net
