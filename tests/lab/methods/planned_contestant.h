// A method made of the engine's parts that chooses by rules of its own.
#pragma once

#include "server/engine/columns/plan.h"
#include "server/engine/columns/signal_state.h"
#include "server/engine/columns/significant_columns.h"
#include "server/engine/error_estimate.h"
#include "server/engine/sums/band_sums.h"
#include "server/scene/scene.h"
#include "tests/lab/methods/contestant.h"
#include "tests/lab/methods/image_maker.h"

#include <memory>
#include <vector>

namespace relume::lab {

// Chooses what the next image changes. Not thread-safe.
class PlanMaker {
  public:
    PlanMaker() = default;
    PlanMaker(const PlanMaker&) = delete;
    PlanMaker& operator=(const PlanMaker&) = delete;
    PlanMaker(PlanMaker&&) = delete;
    PlanMaker& operator=(PlanMaker&&) = delete;
    virtual ~PlanMaker() = default;

    // Replaces the plan's content.
    virtual void make(const served::Scene& scene,
                      const engine::SignalState& lighting,
                      engine::Plan& plan) = 0;
};

class PlannedContestant final : public Contestant {
  public:
    PlannedContestant(std::shared_ptr<const served::Scene> scene,
                      std::unique_ptr<PlanMaker> plan_maker);

    void set_light(const ImageLight& light) override;
    void look(const view::Look& look) override { image_.look(look); }
    Step step() override;
    void write_image(std::span<float> rgb) override { image_.write(rgb); }
    [[nodiscard]] LightingView lighting() const override;
    void write_radiance(light::LightCubemap& out) const override;

  private:
    std::shared_ptr<const served::Scene> scene_;
    ViewImageMaker image_;
    std::unique_ptr<PlanMaker> plan_maker_;
    engine::SignalState lighting_;
    engine::SignificantColumns lit_;
    engine::Plan plan_;
    engine::BandSums images_;
    engine::ErrorEstimate error_;
    std::vector<float> target_;  // planar [3][N]
};

}  // namespace relume::lab
