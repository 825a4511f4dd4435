// The engine over a transport in spherical harmonics: what holds for wavelets holds here.
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

namespace relume::engine {
namespace {

using relighting::Budget;
using relighting::Method;
using relighting::Priority;

constexpr std::uint32_t kOrder = basis::kMaxShOrder;

const TinyScene& sh_scene() {
    static const TinyScene scene(
        {.signal_basis = basis::CubemapBasis::spherical_harmonics(kOrder, 8), .channels = 3});
    return scene;
}

// Made once each: what projects a light is made anew with it.
const std::vector<float>& light(std::uint64_t seed) {
    static std::map<std::uint64_t, std::vector<float>> lights;
    auto& made = lights[seed];
    if (made.empty()) {
        made = test::random_lighting(sh_scene().scene()->projection().basis(), seed);
    }
    return made;
}

constexpr SelectionBudget columns(std::uint32_t count) {
    return {.columns = count, .bytes = ~std::uint64_t{0}};
}

TEST(ShScene, HasABandAnL) {
    const served::Scene& scene = *sh_scene().scene();
    EXPECT_EQ(scene.columns().count(), kOrder * kOrder);
    EXPECT_EQ(scene.columns().band_count(), kOrder);
    for (std::size_t j = 0; j < scene.columns().count(); ++j) {
        EXPECT_EQ(scene.columns().bands()[j], static_cast<std::uint8_t>(std::sqrt(double(j))));
    }
}

// The tolerance of band l is in proportion to l, and the priority its inverse.
TEST(ShScene, ToleranceGrowsWithTheBand) {
    const served::Scene& scene = *sh_scene().scene();
    const auto weights = scene.columns().weights(Priority::area);
    for (std::uint32_t l = 1; l < kOrder; ++l) {
        EXPECT_NEAR(weights[basis::sh_index(l, 0)] * static_cast<float>(l), weights[0], 1e-6F);
    }
}

// Whatever was edited before and by whatever method: at rest the image is the dense product.
RC_GTEST_PROP(ShScene, ReachesTheDenseProductFromAnyHistory, ()) {
    const auto method =
        *rc::gen::element(Method::nwa, Method::bi, Method::pbi, Method::guarded);
    const auto priority = *rc::gen::element(Priority::area, Priority::none, Priority::transport,
                                            Priority::benefit);
    Session session(sh_scene().scene()->workspace(), {.method = method, .priority = priority});
    const int edits = *rc::gen::inRange(0, 5);
    for (int i = 0; i < edits; ++i) {
        session.set_target(light(*rc::gen::inRange<unsigned>(0, 8)));
        for (int step = *rc::gen::inRange(0, 4); step > 0; --step) {
            (void)session.advance_incrementally(columns(*rc::gen::inRange(1U, 100U)));
        }
    }
    const auto& last = light(9);
    session.set_target(last);
    const Budget budget{.milliseconds = std::nullopt, .coefficients = 40, .target_error = 0};
    for (int step = 0; step < 100 && !session.exact(); ++step) {
        (void)session.advance(budget);
    }
    RC_ASSERT(session.exact());
    const auto dense = test::dense_product(sh_scene().transport(), last);
    RC_ASSERT(test::relative_l2(session.sums(), dense) < 1e-5);
}

// A truncated light needs no more columns than its order squared.
TEST(ShScene, LowOrderOfAHigherBakeIsTheProductOfTheTruncatedLight) {
    constexpr std::uint32_t kLow = 5;
    auto truncated = light(1);
    for (std::size_t i = 0; i < truncated.size(); ++i) {
        if (i % basis::sh_count(kOrder) >= basis::sh_count(kLow)) {
            truncated[i] = 0;
        }
    }
    Session session(sh_scene().scene()->workspace(),
                    {.method = Method::nwa, .priority = Priority::none});
    session.set_target(truncated);
    const StepReport step = session.advance_incrementally(columns(basis::sh_count(kLow)));
    EXPECT_EQ(step.applied, basis::sh_count(kLow));
    EXPECT_EQ(step.remaining, 0U);
    EXPECT_LT(test::relative_l2(session.sums(),
                                test::dense_product(sh_scene().transport(), truncated)),
              1e-5);
}

// Per-band increments with a budget come home when the light rests, and say how far they are.
TEST(ShScene, PerBandIncrementalConvergesAndStatesItsError) {
    Session session(sh_scene().scene()->workspace(),
                    {.method = Method::pbi, .priority = Priority::area});
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
        const auto& target = light(seed);
        auto exact = test::dense_product(sh_scene().transport(), target);
        test::receivers_from_sums(exact);
        const auto tint = sh_scene().transport().tint();
        session.set_target(target);
        StepReport step;
        for (int i = 0; i < 10; ++i) {
            step = session.advance_incrementally(columns(40));
            std::vector<double> shown(session.sums().begin(), session.sums().end());
            test::receivers_from_sums(shown);
            double difference = 0;
            double norm = 0;
            for (std::size_t p = 0; p < exact.size(); ++p) {
                difference += std::pow((shown[p] - exact[p]) * double{tint[p]}, 2);
                norm += std::pow(exact[p] * double{tint[p]}, 2);
            }
            const double error = std::sqrt(difference / norm);
            if (error > 1e-5) {
                EXPECT_LT(step.stated_error, 1.5 * error);
                EXPECT_GT(step.stated_error, error / 1.5);
            }
        }
        EXPECT_EQ(step.remaining, 0U);
    }
}

}  // namespace
}  // namespace relume::engine
