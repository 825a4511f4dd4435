// A method that is a session of the engine, whatever the basis of its operator's columns.
#pragma once

#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "server/scene/scene.h"
#include "tests/lab/methods/contestant.h"
#include "tests/lab/methods/image_maker.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace relume::lab {

// How a session relights, and what makes images of its sums.
struct SessionParts {
    std::shared_ptr<const served::Scene> scene;  // whose lights and views they are
    std::shared_ptr<const engine::Workspace> workspace;
    std::unique_ptr<ImageMaker> image;
};

class SessionContestant final : public Contestant {
  public:
    // Of the light, the coefficients from index `coefficients` on are taken for zero: low bands
    // alone, where indices follow bands. Without a budget each image is the whole product.
    SessionContestant(SessionParts parts,
                      relighting::Strategy strategy,
                      const std::optional<engine::SelectionBudget>& budget,
                      std::size_t coefficients);

    void set_light(const ImageLight& light) override;
    void look(const view::Look& look) override;
    Step step() override;
    void write_image(std::span<float> rgb) override { image_->write(rgb); }
    [[nodiscard]] LightingView lighting() const override;
    void write_radiance(light::LightCubemap& out) const override;

  private:
    void weigh_blocks();
    engine::StepReport advance();

    std::shared_ptr<const served::Scene> scene_;
    std::unique_ptr<ImageMaker> image_;
    engine::Session session_;
    std::optional<engine::SelectionBudget> budget_;
    std::size_t coefficients_;
    std::vector<float> target_;
};

// Over the scene's own transport, seen by a view of it; all coefficients, but for
// `coefficients` as above.
[[nodiscard]] std::unique_ptr<Contestant> session_over(
    const std::shared_ptr<const served::Scene>& scene,
    relighting::Strategy strategy,
    const std::optional<engine::SelectionBudget>& budget,
    std::size_t coefficients);

}  // namespace relume::lab
