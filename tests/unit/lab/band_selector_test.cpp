// The selectors of [Overbeck06T 6.2] in their own measure.
#include "tests/lab/methods/band_selector.h"

#include "protocol/relighting/strategy.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <tuple>
#include <utility>

namespace relume::lab {
namespace {

constexpr std::uint32_t kFace = 16;

// A lighting that has followed one light for some images and is then asked for another.
class SelectorTest
    : public testing::TestWithParam<std::tuple<std::pair<std::uint32_t, std::uint64_t>, Norm>> {
  protected:
    SelectorTest()
        : scene_({.signal_basis = basis::CubemapBasis::haar(kFace)}),
          lighting_(scene_.scene()->columns()) {
        const auto [terms, seed] = std::get<0>(GetParam());
        budget_.columns = terms;
        lighting_.set_target(test::random_lighting(kFace, seed));
        rank();
        for (int image = 0; image < 4; ++image) {
            lighting_.apply(plan_with(0));
            rank();
        }
        lighting_.set_target(test::random_lighting(kFace, seed + 1000));
        rank();
    }

    void rank() {
        ranking_.rank(scene_.scene()->columns(), lighting_,
                      scene_.scene()->columns().weights(relighting::Priority::area));
    }
    [[nodiscard]] BandChoice choice() const {
        return {.scene = *scene_.scene(),
                .lighting = lighting_,
                .ranking = ranking_,
                .budget = budget_};
    }
    engine::Plan plan_with(std::uint32_t bands_to_reset) {
        engine::Plan plan;
        plan.bands_to_reset = bands_to_reset;
        selection_.choose(scene_.scene()->columns(), lighting_, ranking_,
                          scene_.scene()->columns().places(), budget_, plan);
        return plan;
    }
    double remaining(std::uint32_t bands_to_reset) {
        return remaining_lighting_error(choice(), plan_with(bands_to_reset), norm());
    }
    static Norm norm() { return std::get<1>(GetParam()); }

    engine::TinyScene scene_;
    engine::SignalState lighting_;
    engine::Ranking ranking_;
    engine::Selection selection_;
    engine::SelectionBudget budget_{.columns = 0, .bytes = ~std::uint64_t{0}};
};

TEST_P(SelectorTest, ExhaustiveLeavesNoMoreThanAnySet) {
    const double best = remaining(make_exhaustive_selector(norm())->bands_to_reset(choice()));
    for (std::uint32_t mask = 0; mask < 1U << scene_.scene()->columns().band_count(); ++mask) {
        EXPECT_LE(best, remaining(mask)) << mask;
    }
}

TEST_P(SelectorTest, DealerLeavesNoMoreThanToGoOnWithNoResets) {
    // Every band it begins anew leaves less of it than the same hand as an increment.
    const double dealt = remaining(make_dealer_selector(norm())->bands_to_reset(choice()));
    EXPECT_LE(dealt, remaining(0) * (1 + 1e-9));
}

TEST_P(SelectorTest, SimpleLeavesNoMoreThanAnySetBeforeTermsAreSpent) {
    const auto before_terms = [&](std::uint32_t mask) {
        engine::Plan nothing;
        nothing.bands_to_reset = mask;
        return remaining_lighting_error(choice(), nothing, norm());
    };
    const double best = before_terms(make_simple_selector(norm())->bands_to_reset(choice()));
    for (std::uint32_t mask = 0; mask < 1U << scene_.scene()->columns().band_count(); ++mask) {
        EXPECT_LE(best, before_terms(mask) * (1 + 1e-12)) << mask;
    }
}

TEST_P(SelectorTest, RemainingErrorIsThatOfTheLightingCarriedOut) {
    const std::uint32_t mask = make_exhaustive_selector(norm())->bands_to_reset(choice());
    const double promised = remaining(mask);
    lighting_.apply(plan_with(mask));
    rank();
    engine::Plan nothing;
    EXPECT_NEAR(remaining_lighting_error(choice(), nothing, norm()), promised, 1e-6 * promised);
}

INSTANTIATE_TEST_SUITE_P(TermsAndSeeds,
                         SelectorTest,
                         testing::Combine(testing::Values(std::pair(1U, 1ULL),
                                                          std::pair(10U, 2ULL),
                                                          std::pair(30U, 3ULL),
                                                          std::pair(30U, 4ULL),
                                                          std::pair(300U, 5ULL),
                                                          std::pair(5000U, 6ULL)),
                                          testing::Values(Norm::l1, Norm::l2)));

TEST(BandSelector, AtRestNothingIsReset) {
    const engine::TinyScene scene({.signal_basis = basis::CubemapBasis::haar(kFace)});
    engine::SignalState lighting(scene.scene()->columns());
    lighting.set_target(test::random_lighting(kFace, 1));
    lighting.apply_all();
    engine::Ranking ranking;
    ranking.rank(scene.scene()->columns(), lighting,
                 scene.scene()->columns().weights(relighting::Priority::area));
    const BandChoice choice{.scene = *scene.scene(),
                            .lighting = lighting,
                            .ranking = ranking,
                            .budget = {.columns = 30, .bytes = ~std::uint64_t{0}}};
    for (const Norm norm : {Norm::l1, Norm::l2}) {
        EXPECT_EQ(make_simple_selector(norm)->bands_to_reset(choice), 0U);
        EXPECT_EQ(make_dealer_selector(norm)->bands_to_reset(choice), 0U);
        EXPECT_EQ(make_exhaustive_selector(norm)->bands_to_reset(choice), 0U);
    }
}

}  // namespace
}  // namespace relume::lab
