// How the engine chooses: what the next image changes, by the session's strategy.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/guard.h"
#include "server/engine/lighting.h"
#include "server/engine/plan.h"
#include "server/engine/ranking.h"
#include "server/engine/selection.h"

namespace relume::engine {

// Chooses, and changes nothing: whoever carries a plan out says so. Not thread-safe.
class Planner {
  public:
    explicit Planner(const Scene& scene) : scene_(&scene), guard_(scene) {}

    // The first image of a new lighting, of which `lit` is what counts: the method's resets,
    // then the most important differences. Valid until the next call.
    [[nodiscard]] const Plan& begin(const Lighting& lighting,
                                    const LitColumns& lit,
                                    const relighting::Strategy& strategy,
                                    const SelectionBudget& budget);
    // While the lighting rests: more of what is left.
    [[nodiscard]] const Plan& go_on(const Lighting& lighting,
                                    const relighting::Strategy& strategy,
                                    const SelectionBudget& budget);

    // The plan has been carried out on L̃.
    void apply(const Plan& plan) { guard_.apply(plan); }
    // L̃ is now this target, whole.
    void approximation_is_target(const LitColumns& target) {
        guard_.approximation_is_target(target);
    }
    // L̃ has changed in ways nobody told.
    void approximation_is_unknown() { guard_.forget(); }

  private:
    const Scene* scene_;
    Ranking ranking_;
    Selection selection_;
    Guard guard_;
    Plan plan_;
};

}  // namespace relume::engine
