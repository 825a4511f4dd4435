#include "server/engine/choosing/guard.h"

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relume::engine {
namespace {

constexpr std::uint64_t kAnyBytes = ~std::uint64_t{0};

// A guard that follows a lighting from edit to edit, as a session has it do.
class GuardTest : public testing::Test {
  protected:
    TinyScene tiny_{{.width = 64, .height = 64, .channels = 3}};
    const served::Scene& scene_ = *tiny_.scene();
    SignalState lighting_{scene_.columns()};
    SignificantColumns lit_{scene_.columns()};
    Ranking ranking_;
    Guard guard_{scene_.columns()};

    const Plan& decide(const std::vector<float>& light, const SelectionBudget& budget) {
        lighting_.set_target(light);
        ranking_.rank(scene_.columns(), lighting_,
                      scene_.columns().weights(relighting::Priority::benefit));
        lit_.set_nearly(light, kSurelyNegligible);
        return guard_.decide(lighting_, lit_, ranking_, budget);
    }
    void carry_out(const Plan& plan) {
        lighting_.apply(plan);
        guard_.apply(plan);
    }
    // ‖T (L − L̃)‖ after a plan, tint applied, from the dense product.
    [[nodiscard]] double error_after(const Plan& plan) const {
        SignalState lighting = lighting_;
        lighting.apply(plan);
        std::vector<float> difference(lighting.target().size());
        for (std::size_t i = 0; i < difference.size(); ++i) {
            difference[i] = lighting.target()[i] - lighting.approximation()[i];
        }
        const auto sums = test::dense_product(tiny_.transport(), difference);
        const auto tint = tiny_.transport().tint();
        double squared = 0;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            squared += std::pow(sums[i] * double{tint[i]}, 2);
        }
        return std::sqrt(squared);
    }
};

// 3·64 rows: the relative standard deviation of a norm lies between 1/√384 and 1/√128.
TEST_F(GuardTest, PredictsTheErrorOfEveryCandidate) {
    std::size_t weighed = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const float sun = seed % 3 == 0 ? 1e4F : 10.0F;
        const Plan plan = decide(test::random_lighting(8, seed, sun), {40, kAnyBytes});
        for (const Guard::Candidate& candidate : guard_.candidates()) {
            EXPECT_NEAR(candidate.predicted_error / error_after(candidate.plan), 1, 0.35)
                << "seed " << seed << ", resets " << candidate.plan.bands_to_reset;
            ++weighed;
        }
        carry_out(plan);
    }
    EXPECT_GE(weighed, 24U) << "resets were weighed against increments";
}

TEST_F(GuardTest, NeverChoosesWhatItPredictsToBeWorse) {
    std::size_t resets = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const float sun = seed % 3 == 0 ? 1e4F : 10.0F;
        const Plan plan = decide(test::random_lighting(8, seed, sun), {40, kAnyBytes});
        const auto candidates = guard_.candidates();
        EXPECT_EQ(candidates.front().plan.bands_to_reset, 0U) << "to go on is always weighed";
        const auto chosen = std::find_if(
            candidates.begin(), candidates.end(), [&](const Guard::Candidate& candidate) {
                return candidate.plan.bands_to_reset == plan.bands_to_reset;
            });
        ASSERT_NE(chosen, candidates.end());
        // Neither going on nor a reset that halves the error is passed over for what is worse.
        for (const Guard::Candidate& other : candidates) {
            if (other.plan.bands_to_reset == 0 ||
                other.predicted_error < guard_.standing_error() / 2) {
                EXPECT_LE(chosen->predicted_error, other.predicted_error);
            }
        }
        if (plan.bands_to_reset != 0) {
            EXPECT_LT(chosen->predicted_error, guard_.standing_error());
        }
        resets += plan.bands_to_reset != 0 ? 1 : 0;
        carry_out(plan);
    }
    EXPECT_GT(resets, 0U);
    EXPECT_LT(resets, 30U);
}

TEST_F(GuardTest, ResetsWhatALightLeftBehind) {
    carry_out(decide(test::random_lighting(8, 1, 1e6F), {384, kAnyBytes}));
    EXPECT_NE(decide(test::random_lighting(8, 2, 1), {10, kAnyBytes}).bands_to_reset, 0U);
}

TEST_F(GuardTest, GoesOnWhereTheBudgetBringsEverything) {
    carry_out(decide(test::random_lighting(8, 1, 1e6F), {384, kAnyBytes}));
    const Plan& plan = decide(test::random_lighting(8, 2, 1), {384, kAnyBytes});
    EXPECT_EQ(plan.remaining_columns(), 0U);
}

// A light given again is a light at rest: whatever the history, images under the same light end
// at the target.
TEST_F(GuardTest, ComesHomeWhenTheSameLightIsGivenAgainAndAgain) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        carry_out(decide(test::random_lighting(8, seed, 1e4F), {20, kAnyBytes}));
    }
    const auto last = test::random_lighting(8, 99);
    carry_out(decide(last, {20, kAnyBytes}));
    for (std::size_t step = 0; step < scene_.columns().count() / 20 + 1; ++step) {
        const Plan plan = decide(last, {20, kAnyBytes});
        EXPECT_EQ(plan.bands_to_reset, 0U);
        carry_out(plan);
    }
    EXPECT_TRUE(std::equal(last.begin(), last.end(), lighting_.approximation().begin()));
}

// What was forgotten is seen again: the decision is that of a guard that followed all along.
TEST_F(GuardTest, DecidesTheSameAfterForgetting) {
    Guard forgetful(scene_.columns());
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Plan plan = decide(test::random_lighting(8, seed, 1e4F), {40, kAnyBytes});
        forgetful.forget();
        const Plan again = forgetful.decide(lighting_, lit_, ranking_, {40, kAnyBytes});
        EXPECT_EQ(again.bands_to_reset, plan.bands_to_reset);
        ASSERT_EQ(forgetful.candidates().size(), guard_.candidates().size());
        for (std::size_t i = 0; i < guard_.candidates().size(); ++i) {
            const double predicted = guard_.candidates()[i].predicted_error;
            // What the ghost of a sun of 10⁴ leaves between two orders of float additions.
            EXPECT_NEAR(forgetful.candidates()[i].predicted_error, predicted, 1e-2 * predicted);
        }
        carry_out(plan);
        forgetful.apply(plan);
    }
}

// A ghost, bigger than all the target: the guarded image is near, the incremental one is not.
TEST(GuardedSession, IsNearerThanGoingOnAfterABrightLight) {
    const TinyScene tiny;
    const relighting::Budget budget{
        .milliseconds = std::nullopt, .coefficients = 10, .target_error = 0};
    double stated[2] = {};
    for (const auto method : {relighting::Method::bi, relighting::Method::guarded}) {
        Session session(tiny.scene()->workspace(),
                        {.method = method, .priority = relighting::Priority::area});
        session.set_target(test::random_lighting(8, 1, 1e6F));
        session.advance({.milliseconds = std::nullopt, .coefficients = 384, .target_error = 0});
        session.set_target(test::random_lighting(8, 2, 1));
        stated[method == relighting::Method::guarded] = session.advance(budget).stated_error;
    }
    EXPECT_GT(stated[0], 100);
    EXPECT_LT(stated[1], 2);
}

}  // namespace
}  // namespace relume::engine
