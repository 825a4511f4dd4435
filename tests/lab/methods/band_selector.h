// Which bands begin anew, chosen with more care than PBI's criterion: the selectors that
// Overbeck's thesis compares it with in 6.2, as README.md of this folder says we understand
// them.
#pragma once

#include "server/engine/lighting.h"
#include "server/engine/plan.h"
#include "server/engine/ranking.h"
#include "server/engine/scene.h"
#include "server/engine/selection.h"

#include <cstdint>
#include <memory>

namespace relume::lab {

// What a selector looks at; `ranking` is of this lighting.
struct BandChoice {
    const engine::Scene& scene;
    const engine::Lighting& lighting;
    const engine::Ranking& ranking;
    engine::SelectionBudget budget;  // in columns
};

// Σ_j ‖w_j (L_j − L̃_j)‖₂ over the colours of every column, w the ranking's weights, once the
// plan has been carried out: the measure that the selectors below make small. Given its bands
// to reset, a plan of engine::Selection has the least.
[[nodiscard]] double remaining_lighting_error(const BandChoice& choice,
                                              const engine::Plan& plan);

// Not thread-safe.
class BandSelector {
  public:
    BandSelector() = default;
    BandSelector(const BandSelector&) = delete;
    BandSelector& operator=(const BandSelector&) = delete;
    BandSelector(BandSelector&&) = delete;
    BandSelector& operator=(BandSelector&&) = delete;
    virtual ~BandSelector() = default;

    // Bit b: band b begins anew.
    [[nodiscard]] virtual std::uint32_t bands_to_reset(const BandChoice& choice) = 0;
};

// Deals the budget's terms to the bands one at a time. A band with k terms is worth the lesser
// of what k terms leave of it as an increment and from nothing; each next term goes to the band
// whose error falls the most by it. In the end a band begins anew where that is the lesser of
// the two. Columns in order once a band; then linear in the terms.
[[nodiscard]] std::unique_ptr<BandSelector> make_dealer_selector();

// Tries all 2^bands sets and takes the one with the least remaining error; of equal ones the
// lowest mask.
[[nodiscard]] std::unique_ptr<BandSelector> make_exhaustive_selector();

}  // namespace relume::lab
