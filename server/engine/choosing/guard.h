// Deciding between incrementing and beginning anew by the error each would leave in the image.
#pragma once

#include "server/engine/choosing/band_sketches.h"
#include "server/engine/choosing/ranking.h"
#include "server/engine/choosing/selection.h"
#include "server/engine/columns/plan.h"
#include "server/engine/columns/signal_state.h"

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// For sets of bands that might begin anew, selects what the budget allows and predicts
// ‖T (L − L̃)‖ after it from the choosing rows of the transport's sketch; the least wins.
// Weighed are: to go on, PBI's resets [Overbeck06 §5], all bands, and, from the best of these
// on, every set that differs by one band, for as long as that gets better. Rows of their own,
// so that the stated error stays an unbiased witness of what was chosen.
//
// Bands begin anew only where that brings the image nearer to the target than it stands, and
// never while the light rests. An increment may make the image worse, columns not being
// orthogonal, and is still a step home; to reset a band and restore it would look better, and
// be to stand still for ever.
//
// Not thread-safe; candidates are worked out side by side in the caller's arena, and the result
// does not depend on it.
class Guard {
  public:
    struct Candidate {
        Plan plan;
        double predicted_error = 0;  // estimated ‖T (L − L̃)‖ once the plan is carried out
    };

    explicit Guard(const ColumnTable& table);

    // `ranking` and `lit`, what counts of the target, are of this signal. The best plan;
    // valid until the next call. Of equal predictions the first wins, increments before resets.
    [[nodiscard]] const Plan& decide(const SignalState& signal,
                                     const SignificantColumns& lit,
                                     Ranking& ranking,
                                     const SelectionBudget& budget);
    // What was weighed by the last decision, to go on first. A candidate that resets is
    // eligible when its error is less than `standing_error`.
    [[nodiscard]] std::span<const Candidate> candidates() const {
        return std::span(candidates_).first(candidate_count_);
    }

    // Estimated ‖T (L − L̃)‖ at the last decision, before any plan.
    [[nodiscard]] double standing_error() const { return standing_error_; }

    // The plan, by whomever it was made, has been carried out on L̃.
    void apply(const Plan& plan);
    // L̃ is now this target, whole.
    void approximation_is_target(const SignificantColumns& target);
    // L̃ or L has changed in other ways; costs one more pass at the next decision.
    void forget() { approximation_known_ = false; }

  private:
    void propose(std::uint32_t bands_to_reset);
    // True when nothing has changed for the image since the last decision.
    [[nodiscard]] bool set_target(const SignificantColumns& lit);
    void search_nearby(const SignalState& signal,
                       const Ranking& ranking,
                       const SelectionBudget& budget);
    void weigh_new(const SignalState& signal,
                   const Ranking& ranking,
                   const SelectionBudget& budget);
    [[nodiscard]] double predicted_error(const Plan& plan) const;
    [[nodiscard]] bool is_better(const Candidate& candidate, const Candidate& than) const;

    const ColumnTable* table_;
    const transport::Sketch* sketch_;
    SignificantColumns shown_;
    BandSketches target_;
    BandSketches approximation_;
    std::vector<double> last_target_;
    bool approximation_known_ = true;
    std::vector<std::uint32_t> shortlist_;
    std::vector<Candidate> candidates_;  // as many as were ever weighed at once
    std::size_t candidate_count_ = 0;
    std::size_t weighed_count_ = 0;
    std::size_t best_ = 0;
    double standing_error_ = 0;
    tbb::enumerable_thread_specific<Selection> selections_;
};

}  // namespace relume::engine
