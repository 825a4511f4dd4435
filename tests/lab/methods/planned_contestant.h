// A method made of the engine's parts that chooses by rules of its own.
#pragma once

#include "server/engine/band_images.h"
#include "server/engine/error_estimate.h"
#include "server/engine/lighting.h"
#include "server/engine/lit_columns.h"
#include "server/engine/plan.h"
#include "server/engine/scene.h"
#include "tests/lab/methods/contestant.h"

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
    virtual void make(const engine::Scene& scene,
                      const engine::Lighting& lighting,
                      engine::Plan& plan) = 0;
};

class PlannedContestant final : public Contestant {
  public:
    PlannedContestant(std::shared_ptr<const engine::Scene> scene,
                      std::unique_ptr<PlanMaker> plan_maker);

    void set_light(const ImageLight& light) override;
    Step step() override;
    void write_image(std::span<float> rgb) const override;
    [[nodiscard]] LightingView lighting() const override;
    void write_radiance(light::LightCubemap& out) const override;

  private:
    std::shared_ptr<const engine::Scene> scene_;
    std::unique_ptr<PlanMaker> plan_maker_;
    engine::Lighting lighting_;
    engine::LitColumns lit_;
    engine::Plan plan_;
    engine::BandImages images_;
    engine::ErrorEstimate error_;
    std::vector<float> target_;  // planar [3][N]
};

}  // namespace relume::lab
