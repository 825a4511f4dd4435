// How important every column's difference between signal and approximation is.
#pragma once

#include "server/engine/choosing/importance_buckets.h"
#include "server/engine/columns/column_table.h"
#include "server/engine/columns/signal_state.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// A ranking is made once for a signal; plans for any set of resets are then selected from it.
// Columns stand in the order of `ColumnTable::by_band`. The work is spread over the caller's
// arena; the result does not depend on the number of threads. Not thread-safe while it is made.
class Ranking {
  public:
    // `weights` as ColumnTable::weights.
    void rank(const ColumnTable& table,
              const SignalState& signal,
              std::span<const float> weights);

    // Importance of every column as it is shown: Σ_c (weight·(L − L̃))², finite; kNoDifference
    // where L and L̃ are equal.
    [[nodiscard]] std::span<const float> as_shown() const { return as_shown_; }
    // Importance of every column if its band begins anew, that is with L̃ = 0.
    [[nodiscard]] std::span<const float> from_nothing() const { return from_nothing_; }
    static constexpr float kNoDifference = -1;

    // Number of columns that differ once the bands of the mask have begun anew.
    [[nodiscard]] std::uint32_t differing_columns(std::uint32_t bands_to_reset) const;

    // Replaces the content of `places` by the places, in order, of all columns that the budget
    // may allow, whatever bands begin anew. Each column has two importances. If all counted by
    // the lesser one, the budget would end at some importance; with any set of bands it ends
    // there or higher. So columns both of whose importances are lower can be left out.
    void shortlist(const ColumnTable& table,
                   const SelectionBudget& budget,
                   std::vector<std::uint32_t>& places);

    // Mask of the bands in which zero is nearer to the target than the approximation is:
    // ‖L_b‖₁ < ‖L_b − L̃_b‖₁ [Overbeck06 §5].
    [[nodiscard]] std::uint32_t bands_nearer_from_nothing() const {
        return bands_nearer_from_nothing_;
    }

  private:
    // ‖L‖₁ and ‖L − L̃‖₁ over some columns, and how many of each are not zero.
    struct Summary {
        double from_nothing = 0;
        double as_shown = 0;
        std::uint32_t wanted = 0;
        std::uint32_t differing = 0;
    };

    [[nodiscard]] Summary rank_chunk(const ColumnTable& table,
                                     const SignalState& signal,
                                     std::span<const float> weights,
                                     const BandChunk& chunk);

    std::vector<float> as_shown_;      // [N]
    std::vector<float> from_nothing_;  // [N]
    std::vector<Summary> chunks_;
    std::array<Summary, basis::kMaxBands> bands_{};
    ImportanceBuckets buckets_;
    std::uint32_t bands_nearer_from_nothing_ = 0;
};

}  // namespace relume::engine
