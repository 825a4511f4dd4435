// How the engine chooses: what the next image changes, by the session's strategy.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/choosing/guard.h"
#include "server/engine/choosing/ranking.h"
#include "server/engine/choosing/selection.h"
#include "server/engine/columns/plan.h"
#include "server/engine/columns/signal_state.h"

namespace relume::engine {

// Chooses, and changes nothing: whoever carries a plan out says so. Not thread-safe.
class Planner {
  public:
    explicit Planner(const ColumnTable& table) : table_(&table), guard_(table) {}

    // The first image of a new signal, of which `lit` is what counts: the method's resets,
    // then the most important differences. Valid until the next call.
    [[nodiscard]] const Plan& begin(const SignalState& signal,
                                    const SignificantColumns& lit,
                                    const relighting::Strategy& strategy,
                                    const SelectionBudget& budget);
    // While the signal rests: more of what is left.
    [[nodiscard]] const Plan& go_on(const SignalState& signal,
                                    const relighting::Strategy& strategy,
                                    const SelectionBudget& budget);

    // The plan has been carried out on L̃.
    void apply(const Plan& plan) { guard_.apply(plan); }
    // L̃ is now this target, whole.
    void approximation_is_target(const SignificantColumns& target) {
        guard_.approximation_is_target(target);
    }
    // L̃ has changed in ways nobody told.
    void approximation_is_unknown() { guard_.forget(); }

  private:
    const ColumnTable* table_;
    Ranking ranking_;
    Selection selection_;
    Guard guard_;
    Plan plan_;
};

}  // namespace relume::engine
