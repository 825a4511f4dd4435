// The laws of the engine over an operator that is no stored transport.
#include "tests/unit/engine/synthetic_operator.h"

namespace relume::engine::synthetic {
namespace {

TEST_F(SyntheticKind, EveryMethodEndsExact) {
    using relighting::Method;
    for (const Method method : {Method::nwa, Method::bi, Method::pbi, Method::guarded}) {
        Session relit = session(method);
        relit.set_target(peak_at(40));
        relit.advance(kTerms);
        relit.set_target(peak_at(180));
        run_to_rest(relit, kTerms);
        EXPECT_LT(error(relit.sums(), peak_at(180)), 1e-6) << name_from(method);
        EXPECT_EQ(relit.stated_error(), 0) << name_from(method);
    }
}

// The errors stated along a drag are those of the receivers' sums. A count sketch of 256 rows
// is within a tenth of the truth, root mean square; a factor of two is five times that.
TEST_F(SyntheticKind, StatesTheErrorOfPbiWhileTheSignalMoves) {
    Session relit = session(relighting::Method::pbi);
    for (int image = 0; image < 40; ++image) {
        const std::vector<float> signal = peak_at(30 + 5.0 * image);
        relit.set_target(signal);
        const StepReport step = relit.advance(kTerms);
        const double truth = error(relit.sums(), signal);
        EXPECT_LE(step.applied, 12U);
        EXPECT_GT(truth, 0);
        EXPECT_LT(step.stated_error, 2 * truth) << image;
        EXPECT_GT(step.stated_error, truth / 2) << image;
    }
    run_to_rest(relit, kTerms);
}

TEST_F(SyntheticKind, GuardedIsNoFurtherThanBiFromWhatIsAsked) {
    Session guarded = session(relighting::Method::guarded);
    Session incremental = session(relighting::Method::bi);
    double guarded_errors = 0;
    double incremental_errors = 0;
    for (int image = 0; image < 40; ++image) {
        const std::vector<float> signal = peak_at(30 + 5.0 * image);
        for (Session* relit : {&guarded, &incremental}) {
            relit->set_target(signal);
            relit->advance(kTerms);
        }
        guarded_errors += error(guarded.sums(), signal);
        incremental_errors += error(incremental.sums(), signal);
    }
    EXPECT_LE(guarded_errors, 1.02 * incremental_errors);
}

TEST_F(SyntheticKind, AnExactResultForgetsItsHistory) {
    Session travelled = session(relighting::Method::guarded);
    for (int image = 0; image < 20; ++image) {
        travelled.set_target(peak_at(12.0 * image));
        travelled.advance(kTerms);
    }
    Session fresh = session(relighting::Method::nwa);
    for (Session* relit : {&travelled, &fresh}) {
        relit->set_target(peak_at(77));
        run_to_rest(*relit, kTerms);
    }
    EXPECT_TRUE(std::equal(fresh.sums().begin(), fresh.sums().end(), travelled.sums().begin()));
}

// Slots that are no receivers, and what was never lit.
TEST_F(SyntheticKind, NothingIsAddedBeyondTheReceivers) {
    Session relit = session(relighting::Method::guarded);
    relit.set_target(peak_at(77));
    run_to_rest(relit, kTerms);
    for (std::size_t i = 0; i < relit.sums().size(); ++i) {
        if (i % kBlockSize >= kClusterSize) {
            ASSERT_EQ(relit.sums()[i], 0) << i;
        }
    }
}

}  // namespace
}  // namespace relume::engine::synthetic
