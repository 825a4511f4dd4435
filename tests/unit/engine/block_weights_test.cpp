// Views that look at some blocks of an operator alone.
#include "tests/unit/engine/synthetic_operator.h"

namespace relume::engine::synthetic {
namespace {

// A view that sees one cluster alone is told of its error, which is not that of all. PBI
// chooses by the signal, so that both sessions show the same.
TEST_F(SyntheticKind, StatesTheErrorOfTheBlocksThatCount) {
    Session seen = session(relighting::Method::pbi);
    Session whole = session(relighting::Method::pbi);
    seen.set_block_weights(std::array{0.25F, 0.0F, 0.0F, 0.0F, 0.0F});
    double missed_by_seen = 0;
    double missed_by_whole = 0;
    for (int image = 0; image < 40; ++image) {
        const std::vector<float> signal = peak_at(30 + 5.0 * image);
        seen.set_target(signal);
        whole.set_target(signal);
        const double stated = seen.advance(kTerms).stated_error;
        const double of_all = whole.advance(kTerms).stated_error;
        const double truth = error(seen.sums(), signal, 1);
        EXPECT_LT(stated, 2 * truth) << image;
        EXPECT_GT(stated, truth / 2) << image;
        missed_by_seen += std::abs(stated - truth);
        missed_by_whole += std::abs(of_all - truth);
    }
    EXPECT_LT(missed_by_seen, 0.8 * missed_by_whole);
}

// A view wanders over the clusters while the signal moves. What it sees is what a session shows
// that keeps all of them up to date, whatever was passed by on the way; at rest all is exact.
TEST_F(SyntheticKind, BlocksThatCountAgainShowWhatTheyMissed) {
    using relighting::Method;
    for (const Method method : {Method::bi, Method::pbi}) {
        Session seen = session(method);
        Session whole = session(method);
        for (int image = 0; image < 60; ++image) {
            if (image == 30) {  // both have bands' sums after an exact image
                run_to_rest(seen, kTerms);
                run_to_rest(whole, kTerms);
            }
            std::array<float, kClusters> weights{};
            const auto first = static_cast<std::size_t>(image / 4) % kClusters;
            weights[first] = 1;
            weights[(first + 2) % kClusters] = 2;
            seen.set_block_weights(weights);
            const std::vector<float> signal = peak_at(20 + 3.5 * image);
            for (Session* relit : {&seen, &whole}) {
                relit->set_target(signal);
                relit->advance(kTerms);
            }
            for (std::size_t block = 0; block < kClusters; ++block) {
                for (std::size_t i = 0; weights[block] > 0 && i < kColours * kBlockSize; ++i) {
                    const std::size_t at = block * kColours * kBlockSize + i;
                    ASSERT_NEAR(seen.sums()[at], whole.sums()[at], 2e-3) << image;
                }
            }
        }
        run_to_rest(seen, kTerms);
        run_to_rest(whole, kTerms);
        EXPECT_TRUE(std::equal(seen.sums().begin(), seen.sums().end(), whole.sums().begin()));
    }
}

}  // namespace
}  // namespace relume::engine::synthetic
