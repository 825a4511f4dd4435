#include "server/engine/spare_images.h"

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

TEST(SpareImages, AreKeptForTheNext) {
    const TinyScene tiny;
    SpareImages spare;
    std::unique_ptr<BandImages> images = spare.take(*tiny.scene());
    const BandImages* const first = images.get();
    spare.give(std::move(images));
    EXPECT_EQ(spare.take(*tiny.scene()).get(), first);
}

// However many take and give at once, nobody holds what another holds.
TEST(SpareImages, HaveOneHolderEach) {
    const TinyScene tiny;
    SpareImages spare;
    std::mutex mutex;
    std::set<const BandImages*> held;
    std::atomic<int> held_twice{0};
    const auto take_and_give = [&] {
        for (int i = 0; i < 300; ++i) {
            std::vector<std::unique_ptr<BandImages>> mine;
            for (int k = 0; k < 6; ++k) {
                mine.push_back(spare.take(*tiny.scene()));
                const std::lock_guard lock(mutex);
                held_twice += held.insert(mine.back().get()).second ? 0 : 1;
            }
            for (std::unique_ptr<BandImages>& images : mine) {
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
