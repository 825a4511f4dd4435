#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <memory>
#include <vector>

namespace relume::engine {
namespace {

using relighting::Budget;
using relighting::Method;
using relighting::Priority;

Budget coefficients(std::uint32_t count) {
    return {.milliseconds = std::nullopt, .coefficients = count, .target_error = 0};
}

std::vector<float> copy(std::span<const float> values) {
    return {values.begin(), values.end()};
}

const TinyScene& scene_of(std::uint32_t channels) {
    static const TinyScene grey({.channels = 1});
    static const TinyScene coloured({.channels = 3, .seed = 2});
    return channels == 1 ? grey : coloured;
}

// A session that is relit with others, and one that goes through the same by itself.
struct Pair {
    std::unique_ptr<Session> together;
    std::unique_ptr<Session> alone;
    Budget budget;
};

void set_target(Pair& pair, std::span<const float> lighting) {
    pair.together->set_target(lighting);
    pair.alone->set_target(lighting);
}

// One step of some of them, in one sweep, and of each by itself.
void step(std::vector<Pair*> pairs) {
    std::vector<SessionStep> turns;
    for (Pair* pair : pairs) {
        turns.push_back(
            {.session = pair->together.get(), .budget = pair->budget, .report = {}});
    }
    Session::advance_together(turns);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const StepReport alone = pairs[i]->alone->advance(pairs[i]->budget);
        RC_ASSERT(turns[i].report.applied == alone.applied);
        RC_ASSERT(turns[i].report.bands_reset == alone.bands_reset);
        RC_ASSERT(turns[i].report.exact == alone.exact);
        RC_ASSERT(turns[i].report.stated_error == alone.stated_error);
    }
}

// Whoever is relit together, in whatever company, with whatever edits in between: every session
// shows what it would show by itself, bit for bit, on the way and at rest.
RC_GTEST_PROP(SessionsTogether, GetTheBitsTheyGetAlone, ()) {
    const TinyScene& tiny = scene_of(*rc::gen::element(1U, 3U));
    // So few that they do not turn to the full product for being many.
    std::vector<Pair> pairs(*rc::gen::inRange<std::size_t>(1, 8));
    for (Pair& pair : pairs) {
        const relighting::Strategy strategy{
            .method = *rc::gen::element(Method::nwa, Method::bi, Method::pbi, Method::guarded),
            .priority = *rc::gen::element(Priority::area, Priority::benefit)};
        pair.together = std::make_unique<Session>(tiny.scene()->workspace(), strategy);
        pair.alone = std::make_unique<Session>(tiny.scene()->workspace(), strategy);
        // Too few to come home, where the company may decide how many steps that takes.
        pair.budget = coefficients(*rc::gen::inRange(1U, 60U));
    }
    for (int round = *rc::gen::inRange(1, 5); round > 0; --round) {
        std::vector<Pair*> company;
        for (Pair& pair : pairs) {
            if (*rc::gen::weightedElement<bool>({{1, true}, {2, false}})) {
                const float sun = *rc::gen::element(0.0F, 300.0F, 1e6F);
                set_target(pair,
                           test::random_lighting(8, *rc::gen::inRange<unsigned>(0, 1000), sun));
            }
            if (*rc::gen::weightedElement<bool>({{4, true}, {1, false}})) {
                company.push_back(&pair);
            }
        }
        step(company);
    }
    for (const Pair& pair : pairs) {
        RC_ASSERT(copy(pair.together->sums()) == copy(pair.alone->sums()));
        RC_ASSERT(copy(pair.together->approximation()) == copy(pair.alone->approximation()));
    }
}

// Some stand in the middle of their full product when others begin theirs; lights that are
// black but for a few texels beside full ones.
TEST(SessionsTogether, ComeHomeFromDifferentPlaces) {
    const TinyScene& tiny = scene_of(3);
    std::vector<Pair> pairs(19);
    std::vector<Pair*> all;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].together = std::make_unique<Session>(tiny.scene()->workspace(), relighting::Strategy{});
        pairs[i].alone = std::make_unique<Session>(tiny.scene()->workspace(), relighting::Strategy{});
        pairs[i].budget = coefficients(100);
        auto light = test::random_lighting(8, i);
        if (i % 2 == 1) {
            std::fill(light.begin() + static_cast<std::ptrdiff_t>(i), light.end(), 0.0F);
        }
        set_target(pairs[i], light);
        all.push_back(&pairs[i]);
        std::vector<SessionStep> turns;
        for (Pair* pair : all) {
            turns.push_back(
                {.session = pair->together.get(), .budget = pair->budget, .report = {}});
        }
        Session::advance_together(turns);
    }
    for (int i = 0; i < 1000; ++i) {
        std::vector<SessionStep> turns;
        for (Pair* pair : all) {
            turns.push_back(
                {.session = pair->together.get(), .budget = pair->budget, .report = {}});
        }
        Session::advance_together(turns);
        for (Pair* pair : all) {
            pair->alone->advance(pair->budget);
        }
    }
    for (const Pair& pair : pairs) {
        ASSERT_TRUE(pair.together->exact() && pair.alone->exact());
        EXPECT_EQ(copy(pair.together->sums()), copy(pair.alone->sums()));
    }
}

}  // namespace
}  // namespace relume::engine
