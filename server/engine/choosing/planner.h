// The engine's choice of what the next image changes, by the session's strategy.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/choosing/guard.h"
#include "server/engine/choosing/ranking.h"
#include "server/engine/choosing/selection.h"
#include "server/engine/columns/plan.h"
#include "server/engine/columns/signal_state.h"

namespace relume::engine {

// Makes plans and carries none of them out. Whoever does tells the planner by `apply`. Not
// thread-safe.
class Planner {
  public:
    explicit Planner(const ColumnTable& table) : table_(&table), guard_(table) {}

    // The plan for the first image of a new signal: the method's resets, then the most
    // important differences. `significant` has the columns of the target that count. Valid
    // until the next call.
    [[nodiscard]] const Plan& begin(const SignalState& signal,
                                    const SignificantColumns& significant,
                                    const relighting::Strategy& strategy,
                                    const SelectionBudget& budget);
    // The plan for a further image of the same signal: the most important of the differences
    // that are left.
    [[nodiscard]] const Plan& go_on(const SignalState& signal,
                                    const relighting::Strategy& strategy,
                                    const SelectionBudget& budget);

    // As ErrorEstimate::set_block_weights.
    void set_block_weights(std::span<const float> weights) { guard_.set_block_weights(weights); }

    // The plan has been carried out on L̃.
    void apply(const Plan& plan) { guard_.apply(plan); }
    // L̃ has been set to this target as a whole.
    void approximation_is_target(const SignificantColumns& target) {
        guard_.approximation_is_target(target);
    }
    // L̃ has changed in another way, which the planner has not been told.
    void approximation_is_unknown() { guard_.forget(); }

  private:
    const ColumnTable* table_;
    Ranking ranking_;
    Selection selection_;
    Guard guard_;
    Plan plan_;
};

}  // namespace relume::engine
