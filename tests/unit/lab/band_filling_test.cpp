// Bands filled from the lowest [Overbeck06T fig. 8.1].
#include "tests/lab/methods/band_filling.h"

#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

constexpr std::uint32_t kFace = 16;
constexpr std::uint32_t kOrder = 6;

class BandFillingTest : public testing::Test {
  protected:
    BandFillingTest()
        : scene_({.signal_basis = basis::CubemapBasis::spherical_harmonics(kOrder, kFace)}),
          lighting_(scene_.scene()->columns()) {}

    void set_target(std::uint64_t seed) {
        std::vector<float> target = test::random_lighting(kFace, seed);
        target.resize(transport::kColours * scene_.scene()->columns().count());
        lighting_.set_target(target);
    }
    engine::Plan plan_with(std::uint32_t columns) {
        engine::Plan plan;
        make_band_filling(columns)->make(*scene_.scene(), lighting_, plan);
        return plan;
    }
    // Of the differences in a band, Σ |L − L̃|, relative to the light.
    [[nodiscard]] double error(std::uint32_t band) const {
        double left = 0;
        double light = 0;
        const std::size_t count = scene_.scene()->columns().count();
        for (std::size_t i = 0; i < lighting_.target().size(); ++i) {
            const double target = lighting_.target()[i];
            light += std::abs(target);
            if (scene_.scene()->columns().bands()[i % count] == band) {
                left += std::abs(target - double{lighting_.approximation()[i]});
            }
        }
        return left / light;
    }

    engine::TinyScene scene_;
    engine::SignalState lighting_;
};

TEST_F(BandFillingTest, ABandWaitsUntilThoseBelowAreWithinTheTolerance) {
    for (std::uint32_t columns = 1; columns <= kOrder * kOrder; ++columns) {
        set_target(columns);
        lighting_.apply(plan_with(columns));
        bool below_are_filled = true;
        for (std::uint32_t band = 0; band < kOrder; ++band) {
            bool is_touched = false;
            for (const std::uint32_t column : scene_.scene()->columns().of_band(band)) {
                is_touched = is_touched || lighting_.difference(column).is_nothing();
            }
            EXPECT_TRUE(below_are_filled || !is_touched) << columns << ", band " << band;
            below_are_filled = below_are_filled && error(band) <= kFirstTolerance;
        }
        lighting_.apply_all();
    }
}

TEST_F(BandFillingTest, SpendsTheBudgetAndNoMore) {
    set_target(1);
    for (const std::uint32_t columns : {1U, 5U, 25U, 36U}) {
        EXPECT_EQ(plan_with(columns).changes.size(), columns);
    }
    EXPECT_EQ(plan_with(1000).changes.size(), std::size_t{kOrder} * kOrder);
}

TEST_F(BandFillingTest, ChangesStandByBandAndIndex) {
    set_target(2);
    const engine::Plan plan = plan_with(20);
    EXPECT_EQ(plan.bands_to_reset, 0U);
    for (std::size_t i = 1; i < plan.changes.size(); ++i) {
        EXPECT_LT(plan.changes[i - 1].column, plan.changes[i].column);  // in SH bands ascend
    }
}

TEST_F(BandFillingTest, AtRestAllIsBroughtInAndThenNothing) {
    set_target(3);
    for (int image = 0; image < 8; ++image) {
        lighting_.apply(plan_with(5));
    }
    EXPECT_EQ(plan_with(5).changes.size(), 0U);
    for (std::uint32_t band = 0; band < kOrder; ++band) {
        EXPECT_EQ(error(band), 0.0);
    }
}

TEST_F(BandFillingTest, ALightThatGoesOutIsTakenBack) {
    set_target(4);
    lighting_.apply_all();
    lighting_.set_target(std::vector<float>(lighting_.target().size()));
    EXPECT_EQ(plan_with(10).changes.size(), 10U);
}

}  // namespace
}  // namespace relume::lab
