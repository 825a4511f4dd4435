// A method that is a session of the engine, whatever the basis of its transport.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "server/scene/scene.h"
#include "tests/lab/methods/contestant.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relume::lab {

class SessionContestant final : public Contestant {
  public:
    // Of the light, the coefficients from index `coefficients` on are taken for zero: low bands
    // alone, where indices follow bands.
    SessionContestant(std::shared_ptr<const served::Scene> scene,
                      relighting::Strategy strategy,
                      const engine::SelectionBudget& budget,
                      std::size_t coefficients);

    void set_light(const ImageLight& light) override;
    Step step() override;
    void write_image(std::span<float> rgb) const override {
        scene_->write_image(session_.sums(), rgb);
    }
    [[nodiscard]] LightingView lighting() const override;
    void write_radiance(light::LightCubemap& out) const override;

  private:
    std::shared_ptr<const served::Scene> scene_;
    engine::Session session_;
    engine::SelectionBudget budget_;
    std::size_t coefficients_;
    std::vector<float> target_;
};

}  // namespace relume::lab
