#include "server/engine/sums/spare_sums.h"

#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace relume::engine {
namespace {

TEST(SpareSums, AreKeptForTheNext) {
    const TinyScene tiny;
    SpareSums spare;
    std::unique_ptr<BandSums> images = spare.take(tiny.scene()->stored_operator());
    const BandSums* const first = images.get();
    spare.give(std::move(images));
    EXPECT_EQ(spare.take(tiny.scene()->stored_operator()).get(), first);
}

// However many take and give at once, nobody holds what another holds.
TEST(SpareSums, HaveOneHolderEach) {
    const TinyScene tiny;
    SpareSums spare;
    std::mutex mutex;
    std::set<const BandSums*> held;
    std::atomic<int> held_twice{0};
    const auto take_and_give = [&] {
        for (int i = 0; i < 300; ++i) {
            std::vector<std::unique_ptr<BandSums>> mine;
            for (int k = 0; k < 6; ++k) {
                mine.push_back(spare.take(tiny.scene()->stored_operator()));
                const std::lock_guard lock(mutex);
                held_twice += held.insert(mine.back().get()).second ? 0 : 1;
            }
            for (std::unique_ptr<BandSums>& images : mine) {
                {
                    const std::lock_guard lock(mutex);
                    held.erase(images.get());
                }
                spare.give(std::move(images));
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i) {
            threads.emplace_back(take_and_give);
        }
    }
    EXPECT_EQ(held_twice, 0);
}

}  // namespace
}  // namespace relume::engine
