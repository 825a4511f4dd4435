#include "server/engine/choosing/planner.h"

namespace relume::engine {

const Plan& Planner::begin(const SignalState& signal,
                           const SignificantColumns& significant,
                           const relighting::Strategy& strategy,
                           const SelectionBudget& budget) {
    ranking_.rank(*table_, signal, table_->weights(strategy.priority));
    if (strategy.method == relighting::Method::guarded) {
        return guard_.decide(signal, significant, ranking_, budget);
    }
    guard_.forget();
    plan_.bands_to_reset = 0;
    if (strategy.method == relighting::Method::pbi) {
        plan_.bands_to_reset = ranking_.bands_nearer_from_nothing();
    } else if (strategy.method == relighting::Method::nwa) {
        // Every image of the non-linear approximation starts from nothing [Ng03 §4].
        plan_.bands_to_reset = (1U << table_->band_count()) - 1;
    }
    selection_.choose(*table_, signal, ranking_, table_->places(), budget, plan_);
    return plan_;
}

const Plan& Planner::go_on(const SignalState& signal,
                           const relighting::Strategy& strategy,
                           const SelectionBudget& budget) {
    ranking_.rank(*table_, signal, table_->weights(strategy.priority));
    plan_.bands_to_reset = 0;
    selection_.choose(*table_, signal, ranking_, table_->places(), budget, plan_);
    return plan_;
}

}  // namespace relume::engine
