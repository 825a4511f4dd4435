// A scene that is baked for cameras that move, and what they see of it.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/scene/scene.h"
#include "server/scene/scene.h"
#include "server/view/view.h"
#include "tests/stability/relit_image.h"
#include "tests/stability/test_light.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::stability {

// Small: direct light of 6×16×16 texels onto at most so many vertices.
[[nodiscard]] bake::BakeParameters surface_parameters(std::uint32_t most_vertices);

// Not thread-safe.
class BakedSurface {
  public:
    BakedSurface(const scene::Scene& scene, const bake::BakeParameters& parameters);

    [[nodiscard]] const std::shared_ptr<const served::Scene>& scene() const { return scene_; }
    [[nodiscard]] const transport::Transport& transport() const { return scene_->transport(); }

    // The sums of the whole product, [blocks][3][256].
    [[nodiscard]] std::vector<float> exact_sums(const Lighting& lighting) const;
    // At rest. Sums may be changed by whoever asks.
    [[nodiscard]] RelitImage image_of_sums(const view::Look& look,
                                           std::span<const float> sums) const;
    [[nodiscard]] RelitImage image(const view::Look& look, const Lighting& lighting) const {
        return image_of_sums(look, exact_sums(lighting));
    }

  private:
    std::shared_ptr<const served::Scene> scene_;
    std::unique_ptr<view::View> view_;
};

}  // namespace relume::stability
