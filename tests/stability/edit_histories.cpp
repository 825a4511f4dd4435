// Whatever was edited before, by whichever methods, in whatever steps, on however many threads:
// the same end has the same bits.
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "tests/stability/provocations.h"
#include "tests/support/random_lighting.h"
#include "tests/support/tiny_transport.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace relume::stability {
namespace {

constexpr std::uint64_t kEnds = 8;  // lightings that histories may end in
constexpr int kMostThreads = 4;

template <typename T, std::size_t N>
T one_of(std::mt19937_64& random, const T (&values)[N]) {
    return values[random() % N];
}

relighting::Strategy random_strategy(std::mt19937_64& random) {
    using enum relighting::Method;
    using enum relighting::Priority;
    return {.method = one_of(random, {nwa, bi, pbi, guarded}),
            .priority = one_of(random, {area, none, relighting::Priority::transport, benefit})};
}

relighting::Budget random_budget(std::mt19937_64& random) {
    return {.milliseconds = {},
            .coefficients = static_cast<std::uint32_t>(1 + random() % 400),
            .target_error = 0};
}

bool all_finite(std::span<const float> values) {
    return std::all_of(values.begin(), values.end(),
                       [](float value) { return std::isfinite(value); });
}

struct Tally {
    double images = 0;
    double not_finite = 0;   // images
    double differing = 0;    // histories that end in other bits than a fresh session
    double not_exact = 0;    // histories that did not come to rest
    double before_rest = 0;  // histories whose last image before rest had other bits
};

// What a session that never saw anything else shows, and how far it is from the dense product
// in double precision.
struct End {
    Lighting lighting;
    std::vector<float> sums;
    double error = 0;
};
End fresh_end(const std::shared_ptr<const served::Scene>& scene, std::uint64_t seed) {
    End end{test::random_lighting(scene->face_resolution(), 4711 + seed), {}, 0};
    engine::Session session(scene->workspace(), {});
    session.set_target(end.lighting);
    run_until_exact(session);
    end.sums.assign(session.sums().begin(), session.sums().end());
    end.error = test::relative_l2(session.sums(),
                                  test::dense_product(scene->transport(), end.lighting));
    return end;
}

void live_through(const std::shared_ptr<const served::Scene>& scene,
                  const End& end,
                  std::mt19937_64& random,
                  Tally& tally) {
    engine::Session session(scene->workspace(), random_strategy(random));
    const auto step = [&](const relighting::Budget& budget) {
        session.advance(budget);
        tally.images += 1;
        tally.not_finite += all_finite(session.sums()) ? 0 : 1;
    };
    for (std::uint64_t edits = random() % 8; edits > 0; --edits) {
        const float sun = one_of(random, {0.0F, 300.0F, 1e6F, 1e10F});
        session.set_target(
            test::random_lighting(scene->face_resolution(), random() % 1000, sun));
        if (random() % 2 == 0) {
            session.set_strategy(random_strategy(random));
        }
        const relighting::Budget budget = random_budget(random);
        for (std::uint64_t steps = random() % 6; steps > 0; --steps) {
            step(budget);
        }
    }
    session.set_target(end.lighting);
    const relighting::Budget budget = random_budget(random);
    const auto differs = [&] {
        return !std::equal(end.sums.begin(), end.sums.end(), session.sums().begin());
    };
    bool before_rest = false;
    for (std::size_t i = 0; i < 2 * scene->columns().count() && !session.exact(); ++i) {
        before_rest = differs();
        step(budget);
    }
    tally.not_exact += session.exact() ? 0 : 1;
    tally.before_rest += before_rest ? 1 : 0;
    tally.differing += differs() ? 1 : 0;
}

Outcome provoke(Workbench& workbench) {
    const std::size_t histories = workbench.choose<std::size_t>(300, 10'000);
    const tbb::global_control at_least(tbb::global_control::max_allowed_parallelism,
                                       kMostThreads);
    Tally tally;
    double largest_error = 0;
    for (const std::uint32_t channels : {1U, 3U}) {
        const auto scene = workbench.tiny(channels);
        std::vector<End> ends;
        for (std::uint64_t seed = 0; seed < kEnds; ++seed) {
            ends.push_back(fresh_end(scene, seed));
            largest_error = std::max(largest_error, ends.back().error);
        }
        std::mt19937_64 random(workbench.seed() * 2 + channels);
        for (std::size_t i = 0; i < histories / 2; ++i) {
            tbb::task_arena arena(1 + static_cast<int>(random() % kMostThreads));
            arena.execute([&] { live_through(scene, ends[random() % kEnds], random, tally); });
            if (i % 100 == 0) {
                workbench.progress(fmt::format("edit_histories, {} channels", channels),
                                   static_cast<double>(2 * i) / static_cast<double>(histories));
            }
        }
    }
    Outcome outcome;
    outcome.findings = {
        {fmt::format("of {} histories, other bits in the image before rest", histories),
         Sense::at_least, 1, tally.before_rest, "sums do remember how they were reached"},
        {"histories that end in other bits than a fresh session", Sense::at_most, 0,
         tally.differing, "an exact image is made from nothing, in a fixed order"},
        {"histories that never became exact", Sense::at_most, 0, tally.not_exact,
         "every step takes a column, or a slice of the full product"},
        {fmt::format("of {:.0f} images, those with a value not finite", tally.images),
         Sense::at_most, 0, tally.not_finite, "lights up to 1e10"},
        {"exact image off the dense product in double, relative L2", Sense::at_most, 1e-5,
         largest_error, "protocol/README.md: what exact means"},
    };
    return outcome;
}

}  // namespace

Failure edit_histories() {
    return {.name = "edit_histories",
            .what = "the image depends on how it was reached",
            .scene =
                "random transport in all encodings, grey and colour, 40x24, n = 8; random "
                "edits, methods, budgets, 1 to 4 threads",
            .provoke = provoke};
}

}  // namespace relume::stability
