#include "server/engine/session.h"

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <random>

namespace relume::engine {
namespace {

using relighting::Budget;
using relighting::Method;
using relighting::Priority;
using relighting::Strategy;

constexpr double kExactTolerance = 1e-5;

Budget coefficients(std::uint32_t count) {
    return {.milliseconds = std::nullopt, .coefficients = count, .target_error = 0};
}

// Advances until at rest; fails when that takes more steps than there are coefficients, twice.
void run_to_rest(Session& session, const Budget& budget) {
    const std::size_t limit = 2 * session.workspace().columns().count() + 10;
    for (std::size_t i = 0; i < limit && !session.at_rest(budget); ++i) {
        session.advance(budget);
    }
    ASSERT_TRUE(session.at_rest(budget));
}

std::vector<float> copy(std::span<const float> values) {
    return {values.begin(), values.end()};
}

const TinyScene& scene_of(std::uint32_t channels) {
    static const TinyScene grey({.channels = 1});
    static const TinyScene coloured({.channels = 3, .seed = 2});
    return channels == 1 ? grey : coloured;
}

Strategy arbitrary_strategy() {
    return {.method = *rc::gen::element(Method::nwa, Method::bi, Method::pbi, Method::guarded),
            .priority = *rc::gen::element(Priority::area, Priority::none, Priority::transport,
                                          Priority::benefit)};
}

// Whatever was edited before, in whatever steps, under whatever methods: at rest the image is
// the dense product of the lighting, and its bits depend on nothing else.
RC_GTEST_PROP(Session, ReachesTheDenseProductFromAnyHistory, ()) {
    const TinyScene& tiny = scene_of(*rc::gen::element(1U, 3U));
    Session session(tiny.scene()->workspace(), arbitrary_strategy());
    const int edits = *rc::gen::inRange(0, 8);
    for (int i = 0; i < edits; ++i) {
        const float sun = *rc::gen::element(0.0F, 300.0F, 1e6F);
        session.set_target(test::random_lighting(8, *rc::gen::inRange<unsigned>(0, 1000), sun));
        if (*rc::gen::arbitrary<bool>()) {
            session.set_strategy(arbitrary_strategy());
        }
        const Budget budget = coefficients(*rc::gen::inRange(1U, 400U));
        for (int step = *rc::gen::inRange(0, 6); step > 0; --step) {
            session.advance(budget);
        }
    }
    const auto last = test::random_lighting(8, 4711);
    session.set_target(last);
    run_to_rest(session, coefficients(*rc::gen::inRange(5U, 100U)));
    RC_ASSERT(session.exact());
    RC_ASSERT(copy(session.approximation()) == last);
    const auto dense = test::dense_product(tiny.transport(), last);
    RC_ASSERT(test::relative_l2(session.sums(), dense) < kExactTolerance);

    Session fresh(tiny.scene()->workspace(), {});
    fresh.set_target(last);
    run_to_rest(fresh, coefficients(1000));
    RC_ASSERT(copy(fresh.sums()) == copy(session.sums()));
}

TEST(Session, NonLinearApproximationWithAllTermsIsTheDenseProduct) {
    const TinyScene& tiny = scene_of(3);
    Session session(tiny.scene()->workspace(),
                    {.method = Method::nwa, .priority = Priority::area});
    const auto light = test::random_lighting(8, 1);
    session.set_target(light);
    session.advance(coefficients(384));
    EXPECT_FALSE(session.exact()) << "the first image is the method's own";
    EXPECT_LT(test::relative_l2(session.sums(), test::dense_product(tiny.transport(), light)),
              kExactTolerance);
}

TEST(Session, NonLinearApproximationForgetsTheImageBefore) {
    const TinyScene& tiny = scene_of(1);
    const Strategy nwa{.method = Method::nwa, .priority = Priority::transport};
    Session after_bright(tiny.scene()->workspace(), nwa);
    Session fresh(tiny.scene()->workspace(), nwa);
    after_bright.set_target(test::random_lighting(8, 1, 1e7F));
    after_bright.advance(coefficients(50));
    for (Session* session : {&after_bright, &fresh}) {
        session->set_target(test::random_lighting(8, 2));
        session->advance(coefficients(50));
    }
    EXPECT_EQ(copy(after_bright.sums()), copy(fresh.sums()));
}

// The incremental methods keep what they have: the second image of a resting light is the
// product of what has been applied.
TEST(Session, ShowsTheProductOfItsApproximation) {
    for (const Method method : {Method::nwa, Method::bi, Method::pbi, Method::guarded}) {
        const TinyScene& tiny = scene_of(3);
        Session session(tiny.scene()->workspace(),
                        {.method = method, .priority = Priority::transport});
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            session.set_target(test::random_lighting(8, seed));
            session.advance(coefficients(30));
            const auto dense =
                test::dense_product(tiny.transport(), copy(session.approximation()));
            EXPECT_LT(test::relative_l2(session.sums(), dense), kExactTolerance);
        }
    }
}

TEST(Session, PerBandIncrementalResetsWhereStartingAfreshIsNearer) {
    const TinyScene& tiny = scene_of(1);
    const auto bright = test::random_lighting(8, 1, 1e6F);
    const auto dim = test::random_lighting(8, 2, 1);
    Session per_band(tiny.scene()->workspace(),
                     {.method = Method::pbi, .priority = Priority::area});
    Session basic(tiny.scene()->workspace(),
                  {.method = Method::bi, .priority = Priority::area});
    for (Session* session : {&per_band, &basic}) {
        session->set_target(bright);
        session->advance(coefficients(384));
        session->set_target(dim);
    }
    EXPECT_EQ(per_band.advance(coefficients(10)).bands_reset, 0b111U);
    EXPECT_EQ(basic.advance(coefficients(10)).bands_reset, 0U);
    EXPECT_LT(per_band.stated_error(), 2);
    EXPECT_GT(basic.stated_error(), 100) << "the ghost of the light that is gone";
}

// [tests/stability 7.4] A light of 10⁵ comes and goes, and nothing of it stays.
TEST(Session, ABrightLightLeavesNothingBehindWhileEditsGoOn) {
    for (const Method method : {Method::bi, Method::pbi, Method::guarded}) {
        const TinyScene& tiny = scene_of(1);
        Session session(tiny.scene()->workspace(),
                        {.method = method, .priority = Priority::transport});
        const auto dim = test::random_lighting(8, 3, 0);
        for (int i = 0; i < 200; ++i) {
            auto light = dim;
            if (i % 2 == 0) {
                light[7] += 1e5F;
            }
            session.set_target(light);
            session.advance(coefficients(384));
        }
        const auto dense = test::dense_product(tiny.transport(), copy(session.approximation()));
        EXPECT_LT(test::relative_l2(session.sums(), dense), 1e-4)
            << "method " << relighting::name_from(method);
    }
}

TEST(Session, IsTheSameOnAnyNumberOfThreads) {
    const TinyScene tiny({.width = 100, .height = 90, .channels = 3, .blocks_per_shard = 4});
    std::vector<float> first;
    for (const int threads : {1, 2, 5}) {
        const tbb::global_control at_least(tbb::global_control::max_allowed_parallelism, 5);
        tbb::task_arena arena(threads);
        arena.execute([&] {
            Session session(tiny.scene()->workspace(), {});
            for (std::uint64_t seed = 0; seed < 5; ++seed) {
                session.set_target(test::random_lighting(8, seed));
                session.advance(coefficients(40));
            }
            if (first.empty()) {
                first = copy(session.sums());
            }
            EXPECT_EQ(copy(session.sums()), first) << threads << " threads";
        });
    }
}

TEST(Session, StatesZeroOnlyWhenExactAndThenDoesNothing) {
    const TinyScene& tiny = scene_of(1);
    Session session(tiny.scene()->workspace(), {});
    EXPECT_TRUE(session.exact()) << "no light, black image";
    session.set_target(test::random_lighting(8, 1));
    EXPECT_GT(session.advance(coefficients(10)).stated_error, 0);
    run_to_rest(session, coefficients(10));
    const StepReport report = session.advance(coefficients(10));
    EXPECT_EQ(report.bytes_touched, 0U);
    EXPECT_EQ(report.applied, 0U);
    EXPECT_FALSE(report.image_changed);
    EXPECT_TRUE(report.exact);
    EXPECT_EQ(report.stated_error, 0);
}

TEST(Session, RestsWhenTheTargetErrorIsMet) {
    const TinyScene& tiny = scene_of(1);
    Session session(tiny.scene()->workspace(), {});
    Budget budget = coefficients(5);
    budget.target_error = 0.2;
    session.set_target(test::random_lighting(8, 1));
    EXPECT_FALSE(session.at_rest(budget));
    run_to_rest(session, budget);
    EXPECT_FALSE(session.exact());
    EXPECT_LE(session.stated_error(), 0.2);
    EXPECT_FALSE(session.at_rest(coefficients(5)));
}

TEST(Session, AMillisecondBudgetConverges) {
    const TinyScene& tiny = scene_of(1);
    Session session(tiny.scene()->workspace(), {});
    const Budget budget{.milliseconds = 0.1, .coefficients = std::nullopt, .target_error = 0};
    session.set_target(test::random_lighting(8, 1));
    run_to_rest(session, budget);
    EXPECT_TRUE(session.exact());
}

TEST(Session, RefusesLightingThatIsNotOne) {
    const TinyScene& tiny = scene_of(1);
    Session session(tiny.scene()->workspace(), {});
    auto light = test::random_lighting(8, 1);
    EXPECT_THROW(session.set_target(std::span(light).first(light.size() - 1)),
                 std::invalid_argument);
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          1.01F * kLargestCoefficient, -1.01F * kLargestCoefficient}) {
        auto broken = light;
        broken[100] = wrong;
        EXPECT_THROW(session.set_target(broken), std::invalid_argument);
    }
    EXPECT_TRUE(session.exact()) << "unchanged by what was refused";
}

// Where the whole product fits into one image's time, a drag is exact at every image; what
// follows with less time states its error as if the sketches had been kept all along.
TEST(Session, IsExactAtEveryImageWhenThereIsTimeForTheWholeProduct) {
    const TinyScene& tiny = scene_of(3);
    const Budget ample{.milliseconds = 1000, .coefficients = std::nullopt, .target_error = 0};
    Session session(tiny.scene()->workspace(), {});
    Session patient(tiny.scene()->workspace(), {});
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const auto light = test::random_lighting(8, seed);
        session.set_target(light);
        const StepReport report = session.advance(ample);
        EXPECT_TRUE(report.exact);
        EXPECT_EQ(report.stated_error, 0);
        patient.set_target(light);
        run_to_rest(patient, coefficients(10));
        EXPECT_EQ(copy(session.sums()), copy(patient.sums()));
    }
    const auto light = test::random_lighting(8, 9);
    for (Session* each : {&session, &patient}) {
        each->set_target(light);
        each->advance(coefficients(10));
    }
    EXPECT_FALSE(session.exact());
    EXPECT_NEAR(session.stated_error(), patient.stated_error(), 1e-6);
    EXPECT_EQ(copy(session.sums()), copy(patient.sums()));
}

TEST(Session, WritesTheTintedImageInPixelOrder) {
    const TinyScene& tiny = scene_of(3);
    Session session(tiny.scene()->workspace(), {});
    session.set_target(test::random_lighting(8, 1));
    run_to_rest(session, coefficients(384));
    const auto& image = tiny.scene()->image();
    std::vector<float> rgb(3UL * image.width * image.height);
    tiny.scene()->write_image(session.sums(), rgb);
    std::vector<double> receivers(session.sums().begin(), session.sums().end());
    test::receivers_from_sums(receivers);
    for (const auto& [x, y] : {std::pair{0U, 0U}, {39U, 23U}, {17U, 16U}}) {
        const auto [block, slot] = image.place_from_pixel(x, y);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t i = (block * 3 + c) * 256 + slot;
            const double expected = receivers[i] * double{tiny.transport().tint()[i]};
            EXPECT_NEAR(rgb[(y * image.width + x) * 3 + c], expected,
                        1e-5 * std::abs(expected) + 1e-6);
        }
    }
    rgb.pop_back();
    EXPECT_THROW(tiny.scene()->write_image(session.sums(), rgb), std::invalid_argument);
}

}  // namespace
}  // namespace relume::engine
