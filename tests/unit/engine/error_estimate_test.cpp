#include "server/engine/error_estimate.h"

#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::engine {
namespace {

SignificantColumns lit(const TinyScene& tiny, const std::vector<float>& lighting) {
    SignificantColumns columns(tiny.scene()->columns());
    columns.set(lighting);
    return columns;
}

// ‖tint·T·lighting‖ from the dense product.
double true_norm(const TinyScene& tiny, const std::vector<float>& lighting) {
    auto sums = test::dense_product(tiny.transport(), lighting);
    test::receivers_from_sums(sums);
    const auto tint = tiny.transport().tint();
    double squared = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        squared += std::pow(sums[i] * double{tint[i]}, 2);
    }
    return std::sqrt(squared);
}

TEST(ErrorEstimate, IsNearTheTrueErrorForUnseenLighting) {
    const TinyScene tiny({.width = 64, .height = 64, .channels = 3});
    ErrorEstimate estimate(tiny.scene()->columns());
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const auto target = test::random_lighting(8, seed);
        auto approximation = target;
        auto difference = std::vector<float>(target.size());
        // What an incremental method leaves: many small differences.
        for (std::size_t i = seed % 7; i < target.size(); i += 7) {
            approximation[i] = 0;
            difference[i] = target[i];
        }
        estimate.set_target(lit(tiny, target));
        estimate.set_approximation(lit(tiny, approximation));
        const double truth = true_norm(tiny, difference) / true_norm(tiny, target);
        EXPECT_NEAR(estimate.relative_l2() / truth, 1, 0.25) << "seed " << seed;
    }
}

TEST(ErrorEstimate, FollowsChangesAsIfComputedAnew) {
    const TinyScene tiny;
    const served::Scene& scene = *tiny.scene();
    const auto target = test::random_lighting(8, 1);
    ErrorEstimate changed(scene.columns());
    ErrorEstimate anew(scene.columns());
    changed.set_target(lit(tiny, target));
    anew.set_target(lit(tiny, target));
    std::vector<float> approximation(target.size());
    for (std::size_t j = 0; j < scene.columns().count(); j += 3) {
        Plan plan;
        ColumnChange& change =
            plan.changes.emplace_back(ColumnChange{.column = static_cast<std::uint32_t>(j)});
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            const std::size_t i = c * scene.columns().count() + j;
            change.to[c] = target[i];
            approximation[i] = target[i];
        }
        changed.apply(plan);
    }
    anew.set_approximation(lit(tiny, approximation));
    EXPECT_NEAR(changed.relative_l2(), anew.relative_l2(), 1e-5 * anew.relative_l2());
}

TEST(ErrorEstimate, ForgetsABandThatIsReset) {
    const TinyScene tiny;
    const served::Scene& scene = *tiny.scene();
    const std::size_t count = scene.columns().count();
    const auto target = test::random_lighting(8, 4);
    // In the second band a light of 10⁶ that is then taken away.
    auto bright = target;
    auto without = target;
    for (std::size_t i = 0; i < target.size(); ++i) {
        if (scene.columns().bands()[i % count] == 1) {
            bright[i] = 1e6F;
            without[i] = 0;
        }
    }
    ErrorEstimate reset(scene.columns());
    ErrorEstimate anew(scene.columns());
    reset.set_target(lit(tiny, target));
    anew.set_target(lit(tiny, target));
    reset.set_approximation(lit(tiny, bright));
    EXPECT_GT(reset.relative_l2(), 100);
    Plan plan;
    plan.bands_to_reset = 1U << 1;
    reset.apply(plan);
    anew.set_approximation(lit(tiny, without));
    EXPECT_NEAR(reset.relative_l2(), anew.relative_l2(), 1e-5 * anew.relative_l2());
}

TEST(ErrorEstimate, KnowsNothingAndBlack) {
    const TinyScene tiny;
    ErrorEstimate estimate(tiny.scene()->columns());
    EXPECT_EQ(estimate.relative_l2(), 0) << "black shown, black wanted";
    const auto light = test::random_lighting(8, 2);
    estimate.set_target(lit(tiny, light));
    EXPECT_EQ(estimate.relative_l2(), 1) << "nothing shown yet";
    estimate.approximation_is_target(lit(tiny, light));
    EXPECT_EQ(estimate.relative_l2(), 0);
    estimate.set_target(lit(tiny, std::vector<float>(light.size())));
    EXPECT_EQ(estimate.relative_l2(), 1) << "light shown, black wanted";
}

}  // namespace
}  // namespace relume::engine
