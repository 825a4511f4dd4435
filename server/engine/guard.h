// Deciding between incrementing and beginning anew by the error each would leave in the image.
#pragma once

#include "server/engine/band_sketches.h"
#include "server/engine/lighting.h"
#include "server/engine/plan.h"
#include "server/engine/ranking.h"
#include "server/engine/selection.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// For every set of bands that might begin anew, selects what the budget allows and predicts
// ‖T (L − L̃)‖ after it from the choosing rows of the transport's sketch; the least wins. Rows
// of their own, so that the stated error stays an unbiased witness of what was chosen. Not
// thread-safe; candidates are worked out side by side in the caller's arena.
class Guard {
  public:
    struct Candidate {
        Plan plan;
        double predicted_error = 0;  // estimated ‖T (L − L̃)‖ once the plan is carried out
    };

    explicit Guard(const Scene& scene);

    // `ranking` is of this lighting. The best plan; valid until the next call. Of equal
    // predictions the first wins, increments before resets.
    [[nodiscard]] const Plan& decide(const Lighting& lighting,
                                     const Ranking& ranking,
                                     const SelectionBudget& budget);
    // What was weighed by the last decision.
    [[nodiscard]] std::span<const Candidate> candidates() const {
        return std::span(candidates_).first(candidate_count_);
    }

    // The plan, by whomever it was made, has been carried out on L̃.
    void apply(const Plan& plan);
    // L̃ is the L of the last decision.
    void approximation_is_target();
    // L̃ or L has changed in other ways; costs one more pass at the next decision.
    void forget() { approximation_known_ = false; }

  private:
    static constexpr std::size_t kMostCandidates = 4;

    void propose(std::uint32_t bands_to_reset);
    [[nodiscard]] std::uint32_t bands_fainter_from_nothing() const;
    [[nodiscard]] double predicted_error(const Plan& plan) const;

    const Scene* scene_;
    const transport::Sketch* sketch_;
    BandSketches target_;
    BandSketches approximation_;
    bool approximation_known_ = true;
    std::vector<Candidate> candidates_;
    std::vector<Selection> selections_;  // one a candidate
    std::size_t candidate_count_ = 0;
};

}  // namespace relume::engine
