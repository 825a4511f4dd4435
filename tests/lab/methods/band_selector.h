// Which bands begin anew: the selectors of [Overbeck06T 6.2].
#pragma once

#include "server/engine/choosing/ranking.h"
#include "server/engine/choosing/selection.h"
#include "server/engine/columns/plan.h"
#include "server/scene/scene.h"
#include "server/engine/columns/signal_state.h"

#include <cstdint>
#include <memory>

namespace relume::lab {

// What a selector looks at; `ranking` is of this lighting.
struct BandChoice {
    const served::Scene& scene;
    const engine::SignalState& lighting;
    const engine::Ranking& ranking;
    engine::SelectionBudget budget;  // in columns
};

// How the differences of columns make an error, each the L2 norm over its colours times the
// ranking's weight, which is the wavelet's area in the papers: their sum, or the sum of their
// squares (whose root orders sets of bands alike).
enum class Norm : std::uint8_t { l1, l2 };

// The lighting's error in that norm once the plan has been carried out: what the selectors
// below make small. Given its bands to reset, a plan of engine::Selection has the least.
[[nodiscard]] double remaining_lighting_error(const BandChoice& choice,
                                              const engine::Plan& plan,
                                              Norm norm);

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

// Each band by itself: it begins anew where its light is nearer to nothing than to what is
// shown. Blind to the budget. With L1 over coefficients this is the engine's own PBI.
[[nodiscard]] std::unique_ptr<BandSelector> make_simple_selector(Norm norm);

// Deals the budget's terms to the bands one at a time. A band with k terms is worth the lesser
// of what k terms leave of it as an increment and from nothing; each next term goes to the band
// whose error falls the most by it. In the end a band begins anew where that is the lesser of
// the two. Columns in order once a band; then linear in the terms.
[[nodiscard]] std::unique_ptr<BandSelector> make_dealer_selector(Norm norm);

// Tries all 2^bands sets and takes the one with the least remaining error; of equal ones the
// lowest mask: optimal within one image.
[[nodiscard]] std::unique_ptr<BandSelector> make_exhaustive_selector(Norm norm);

}  // namespace relume::lab
