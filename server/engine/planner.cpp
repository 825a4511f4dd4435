#include "server/engine/planner.h"

namespace relume::engine {

const Plan& Planner::begin(const Lighting& lighting,
                           const LitColumns& lit,
                           const relighting::Strategy& strategy,
                           const SelectionBudget& budget) {
    ranking_.rank(*scene_, lighting, scene_->weights(strategy.priority));
    if (strategy.method == relighting::Method::guarded) {
        return guard_.decide(lighting, lit, ranking_, budget);
    }
    guard_.forget();
    plan_.bands_to_reset = 0;
    if (strategy.method == relighting::Method::pbi) {
        plan_.bands_to_reset = ranking_.bands_nearer_from_nothing();
    } else if (strategy.method == relighting::Method::nwa) {
        // Every image of the non-linear approximation starts from nothing [Ng03 §4].
        plan_.bands_to_reset = (1U << scene_->band_count()) - 1;
    }
    selection_.choose(*scene_, lighting, ranking_, scene_->places(), budget, plan_);
    return plan_;
}

const Plan& Planner::go_on(const Lighting& lighting,
                           const relighting::Strategy& strategy,
                           const SelectionBudget& budget) {
    ranking_.rank(*scene_, lighting, scene_->weights(strategy.priority));
    plan_.bands_to_reset = 0;
    selection_.choose(*scene_, lighting, ranking_, scene_->places(), budget, plan_);
    return plan_;
}

}  // namespace relume::engine
