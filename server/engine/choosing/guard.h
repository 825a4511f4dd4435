// The decision which bands begin anew, by the error that each choice would leave in the image.
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

// A candidate is a set of bands that begin anew, with the columns that the budget then allows.
// The guard predicts the error ‖T (L − L̃)‖ after each candidate from the choosing sketch, and
// takes the one with the least. It weighs no band, the bands that PBI resets [Overbeck06 §5],
// and all bands. From the best of these it goes on to every set that differs by one band, for
// as long as the error falls. The choosing sketch has rows of its own, so that the estimate by
// the stating sketch stays unbiased.
//
// Bands begin anew only where that brings the image nearer to the target than it stands, and
// never while the signal rests. Columns are not orthogonal, so an increment can make the image
// worse; but it brings L̃ nearer to L, and increments come to an end. To reset a band and to
// restore it could look better every time, and would never end.
//
// Not thread-safe. Candidates are worked out side by side in the caller's arena; the result
// does not depend on the number of threads.
class Guard {
  public:
    struct Candidate {
        Plan plan;
        double predicted_error = 0;  // estimated ‖T (L − L̃)‖ once the plan is carried out
    };

    explicit Guard(const ColumnTable& table);

    // The best plan, valid until the next call. `ranking` is of this signal, and `significant`
    // has the columns of its target that count. Of equal predictions the first wins, increments
    // before resets.
    [[nodiscard]] const Plan& decide(const SignalState& signal,
                                     const SignificantColumns& significant,
                                     Ranking& ranking,
                                     const SelectionBudget& budget);
    // What the last decision weighed; the first candidate resets no band. A candidate that
    // resets bands can win only if its error is less than `standing_error`.
    [[nodiscard]] std::span<const Candidate> candidates() const {
        return std::span(candidates_).first(candidate_count_);
    }

    // Estimated ‖T (L − L̃)‖ at the last decision, before any plan.
    [[nodiscard]] double standing_error() const { return standing_error_; }

    // As ErrorEstimate::set_block_weights.
    void set_block_weights(std::span<const float> weights) {
        target_.set_block_weights(weights);
        approximation_.set_block_weights(weights);
    }

    // Has to be called when a plan, of whatever origin, has been carried out on L̃.
    void apply(const Plan& plan);
    // L̃ has been set to this target as a whole.
    void approximation_is_target(const SignificantColumns& target);
    // L̃ or L has changed in another way. The next decision takes one more pass over the sketch.
    void forget() { approximation_known_ = false; }

  private:
    void propose(std::uint32_t bands_to_reset);
    // True when nothing has changed for the image since the last decision.
    [[nodiscard]] bool set_target(const SignificantColumns& significant);
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
