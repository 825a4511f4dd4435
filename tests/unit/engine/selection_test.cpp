#include "server/engine/choosing/selection.h"

#include "protocol/relighting/strategy.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace relume::engine {
namespace {

constexpr std::uint64_t kAnyBytes = ~std::uint64_t{0};

class SelectionTest : public testing::TestWithParam<relighting::Priority> {
  protected:
    TinyScene tiny_;
    const served::Scene& scene_ = *tiny_.scene();
    SignalState lighting_{scene_.columns()};
    Ranking ranking_;
    Selection selection_;

    // The plan for these resets.
    [[nodiscard]] Plan chosen(const SelectionBudget& budget, std::uint32_t bands_to_reset = 0) {
        Plan plan;
        plan.bands_to_reset = bands_to_reset;
        ranking_.rank(scene_.columns(), lighting_, scene_.columns().weights(GetParam()));
        selection_.choose(scene_.columns(), lighting_, ranking_, scene_.columns().places(),
                          budget, plan);
        return plan;
    }

    [[nodiscard]] double importance(std::size_t j) const {
        const auto weights = scene_.columns().weights(GetParam());
        double sum = 0;
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            const std::size_t i = c * scene_.columns().count() + j;
            const double weighted = double{weights[i]} * double{lighting_.target()[i]};
            sum += weighted * weighted;
        }
        return sum;
    }
};

TEST_P(SelectionTest, TakesTheMostImportantDifferences) {
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 5));
    std::vector<double> all(scene_.columns().count());
    for (std::size_t j = 0; j < all.size(); ++j) {
        all[j] = importance(j);
    }
    std::sort(all.rbegin(), all.rend());
    for (const std::uint32_t columns : {1U, 30U, 64U, 65U, 300U}) {
        const Plan plan = chosen({columns, kAnyBytes});
        const auto& changes = plan.changes;
        ASSERT_EQ(changes.size(), columns);
        for (const ColumnChange& change : changes) {
            EXPECT_GE(importance(change.column), all[columns - 1] * (1 - 1e-5));
        }
        EXPECT_TRUE(std::is_sorted(changes.begin(), changes.end(), [&](auto& a, auto& b) {
            return std::pair(scene_.columns().bands()[a.column], a.column) <
                   std::pair(scene_.columns().bands()[b.column], b.column);
        }));
    }
}

// At equal bytes no other priority promises to bring more energy into the image.
TEST(Benefit, BringsTheMostEnergyForItsBytes) {
    const TinyScene tiny;
    const served::Scene& scene = *tiny.scene();
    SignalState lighting(scene.columns());
    Ranking ranking;
    Selection selection;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        lighting.set_target(test::random_lighting(scene.face_resolution(), seed));
        const auto energy_within = [&](relighting::Priority priority) {
            Plan plan;
            ranking.rank(scene.columns(), lighting, scene.columns().weights(priority));
            selection.choose(scene.columns(), lighting, ranking, scene.columns().places(),
                             {~0U, scene.transport().total_bytes() / 8}, plan);
            double energy = 0;
            for (const ColumnChange& change : plan.changes) {
                for (std::uint32_t c = 0; c < transport::kColours; ++c) {
                    energy += double{scene.transport().energy(change.column, c)} *
                              change.amount(c) * change.amount(c);
                }
            }
            return energy;
        };
        const double most = energy_within(relighting::Priority::benefit);
        for (const auto priority : {relighting::Priority::area, relighting::Priority::none,
                                    relighting::Priority::transport}) {
            EXPECT_GT(most, energy_within(priority) * 0.99) << relighting::name_from(priority);
        }
    }
}

TEST_P(SelectionTest, StaysWithinTheBytesButTakesOne) {
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 6));
    const std::uint64_t budget = scene_.transport().total_bytes() / 10;
    const Plan within = chosen({~0U, budget});
    EXPECT_LE(within.bytes, budget);
    EXPECT_GT(within.bytes, budget / 2);
    std::uint64_t bytes = 0;
    for (const ColumnChange& change : within.changes) {
        bytes += scene_.columns().bytes(change.column);
    }
    EXPECT_EQ(within.bytes, bytes);
    EXPECT_EQ(chosen({~0U, 0}).changes.size(), 1U);
    const Plan all = chosen({~0U, kAnyBytes});
    EXPECT_EQ(all.changes.size(), all.differing_columns);
    EXPECT_EQ(all.remaining_columns(), 0U);
}

TEST_P(SelectionTest, EqualLightingHasNoDifferences) {
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 7));
    lighting_.apply_all();
    const Plan plan = chosen({30, kAnyBytes});
    EXPECT_TRUE(plan.changes.empty());
    EXPECT_EQ(plan.differing_columns, 0U);
}

// A plan with resets is the plan of a lighting in which those bands are black.
TEST_P(SelectionTest, ResetsAreWeighedAsIfCarriedOut) {
    const auto before = test::random_lighting(scene_.face_resolution(), 8);
    const auto after = test::random_lighting(scene_.face_resolution(), 9);
    for (std::uint32_t mask = 0; mask < 1U << scene_.columns().band_count(); ++mask) {
        lighting_.set_target(before);
        lighting_.apply_all();
        lighting_.set_target(after);
        const Plan foreseen = chosen({40, kAnyBytes}, mask);
        Plan resets_alone;
        resets_alone.bands_to_reset = mask;
        lighting_.apply(resets_alone);
        const Plan carried_out = chosen({40, kAnyBytes});
        ASSERT_EQ(foreseen.changes.size(), carried_out.changes.size());
        for (std::size_t i = 0; i < foreseen.changes.size(); ++i) {
            EXPECT_EQ(foreseen.changes[i].column, carried_out.changes[i].column);
            EXPECT_EQ(foreseen.changes[i].from, carried_out.changes[i].from);
            EXPECT_EQ(foreseen.changes[i].to, carried_out.changes[i].to);
        }
        EXPECT_EQ(foreseen.bytes, carried_out.bytes);
        EXPECT_EQ(foreseen.differing_columns, carried_out.differing_columns);
    }
}

// Whatever begins anew, what the shortlist leaves out would not have been chosen.
TEST_P(SelectionTest, TheShortlistHoldsWhatIsChosenOfAll) {
    const std::uint64_t all_bytes = scene_.transport().total_bytes();
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 10));
    lighting_.apply_all();
    lighting_.set_target(test::random_lighting(scene_.face_resolution(), 11));
    for (const SelectionBudget& budget : {SelectionBudget{1, kAnyBytes},
                                          {20, kAnyBytes},
                                          {~0U, all_bytes / 30},
                                          {100, all_bytes / 10},
                                          {~0U, 0},
                                          {~0U, kAnyBytes}}) {
        for (std::uint32_t mask = 0; mask < 1U << scene_.columns().band_count(); ++mask) {
            const Plan of_all = chosen(budget, mask);
            std::vector<std::uint32_t> places;
            ranking_.shortlist(scene_.columns(), budget, places);
            Plan of_shortlist;
            of_shortlist.bands_to_reset = mask;
            selection_.choose(scene_.columns(), lighting_, ranking_, places, budget,
                              of_shortlist);
            ASSERT_EQ(of_shortlist.changes.size(), of_all.changes.size());
            for (std::size_t i = 0; i < of_all.changes.size(); ++i) {
                EXPECT_EQ(of_shortlist.changes[i].column, of_all.changes[i].column);
            }
            EXPECT_EQ(of_shortlist.bytes, of_all.bytes);
        }
    }
}

// SignalState at the ends of what floats hold is ranked, not mistaken for equal.
TEST_P(SelectionTest, RanksWhatCannotBeSquared) {
    std::vector<float> huge(scene_.columns().count() * transport::kColours,
                            kLargestCoefficient);
    lighting_.set_target(huge);
    lighting_.apply_all();
    for (float& value : huge) {
        value = -value;
    }
    huge[5] = 1e-38F;
    lighting_.set_target(huge);
    const Plan plan = chosen({30, kAnyBytes});
    EXPECT_EQ(plan.changes.size(), 30U);
    EXPECT_EQ(plan.differing_columns, scene_.columns().count());
}

INSTANTIATE_TEST_SUITE_P(Priorities,
                         SelectionTest,
                         testing::Values(relighting::Priority::area,
                                         relighting::Priority::none,
                                         relighting::Priority::transport,
                                         relighting::Priority::benefit));

}  // namespace
}  // namespace relume::engine
