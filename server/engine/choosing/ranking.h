// How important every column's difference between signal and approximation is.
#pragma once

#include "server/engine/choosing/importance_buckets.h"
#include "server/engine/columns/signal_state.h"
#include "server/engine/columns/column_table.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Made once for a signal; plans for any set of resets are then selected from it. Columns
// stand in the order of `ColumnTable::by_band`. Work is spread over the caller's arena, the
// result does not depend on it. Not thread-safe while being made.
class Ranking {
  public:
    // `weights` as ColumnTable::weights.
    void rank(const ColumnTable& table,
              const SignalState& signal,
              std::span<const float> weights);

    // Σ_c (weight·(L − L̃))², finite; kNoDifference where both are equal.
    [[nodiscard]] std::span<const float> as_shown() const { return as_shown_; }
    // The same were L̃ zero.
    [[nodiscard]] std::span<const float> from_nothing() const { return from_nothing_; }
    static constexpr float kNoDifference = -1;

    // Columns that differ once the bands of the mask have begun anew.
    [[nodiscard]] std::uint32_t differing_columns(std::uint32_t bands_to_reset) const;

    // Of all places, in order, those that may be chosen within the budget whatever bands begin
    // anew: the importance at which a budget ends is never below the one at which it ends when
    // every column counts by the lesser of its two importances. Replaces the content of
    // `places`.
    void shortlist(const ColumnTable& table,
                   const SelectionBudget& budget,
                   std::vector<std::uint32_t>& places);

    // Bands in which starting afresh is nearer to the target than what is shown,
    // ‖L_b‖₁ < ‖L_b − L̃_b‖₁ [Overbeck06 §5], as a bit mask.
    [[nodiscard]] std::uint32_t bands_nearer_from_nothing() const {
        return bands_nearer_from_nothing_;
    }

  private:
    // ‖L‖₁ and ‖L − L̃‖₁ over some columns, and how many of each are not zero.
    struct Summary {
        double from_nothing = 0;
        double as_shown = 0;
        std::uint32_t lit = 0;
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
