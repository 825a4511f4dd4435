// An image costs no allocation once a session has seen a few: heap locks would make sessions
// wait for each other.
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "tests/support/random_lighting.h"
#include "tests/support/timing.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace {

std::atomic<std::size_t> allocations{0};

void* counted(std::size_t bytes) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(bytes)) {
        return memory;
    }
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) {
    return counted(bytes);
}
void* operator new[](std::size_t bytes) {
    return counted(bytes);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(bytes);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace relume::engine {
namespace {

// Sessions that are dragged through a few lights, with a little rest under each.
class Drag {
  public:
    Drag(relighting::Method method, std::size_t sessions) : scene_({.channels = 3}) {
        constexpr std::uint64_t kLights = 5;
        for (std::uint64_t light = 0; light < kLights; ++light) {
            lights_.push_back(test::random_lighting(8, light));
        }
        for (std::size_t i = 0; i < sessions; ++i) {
            sessions_.push_back(std::make_unique<Session>(
                scene_.scene()->workspace(),
                relighting::Strategy{.method = method,
                                     .priority = relighting::Priority::benefit}));
            steps_.push_back({.session = sessions_.back().get(),
                              .budget = {.milliseconds = std::nullopt, .coefficients = 20},
                              .report = {}});
        }
    }

    void go_around() {
        constexpr int kSteps = 3;
        for (const std::vector<float>& light : lights_) {
            for (const auto& session : sessions_) {
                session->set_target(light);
            }
            for (int step = 0; step < kSteps; ++step) {
                Session::advance_together(steps_);
            }
        }
    }

    void come_to_rest() {
        while (!sessions_.front()->exact()) {
            Session::advance_together(steps_);
        }
    }

  private:
    TinyScene scene_;
    std::vector<std::vector<float>> lights_;
    std::vector<std::unique_ptr<Session>> sessions_;
    std::vector<SessionStep> steps_;
};

class Allocation : public testing::TestWithParam<relighting::Method> {};

// On one thread, so that no thread meets its first image late.
TEST_P(Allocation, NoneInTheSteadyState) {
    for (const std::size_t sessions : {1UL, 5UL}) {
        test::with_threads(1, [&] {
            Drag drag(GetParam(), sessions);
            for (int warm_up = 0; warm_up < 3; ++warm_up) {
                drag.go_around();
                drag.come_to_rest();
            }
            const std::size_t before = allocations;
            drag.go_around();
            drag.come_to_rest();
            EXPECT_EQ(allocations - before, 0U) << sessions << " sessions";
        });
    }
}

INSTANTIATE_TEST_SUITE_P(Methods,
                         Allocation,
                         testing::Values(relighting::Method::nwa,
                                         relighting::Method::bi,
                                         relighting::Method::pbi,
                                         relighting::Method::guarded));

}  // namespace
}  // namespace relume::engine
