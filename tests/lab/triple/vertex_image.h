// The image of a factored surface as radiances of the vertices that a camera sees.
#pragma once

#include "server/view/mesh/vertex_radiance.h"
#include "tests/lab/methods/image_maker.h"
#include "tests/lab/triple/seen_surface.h"

#include <Imath/ImathVec.h>

#include <memory>
#include <vector>

namespace relume::lab {

// Of a scene whose vertices are those of `surface`, and which has one material. What a method
// needs from sums to radiances is the terms of the vertices, which `take` makes, and the BRDF's
// second factors at them, with which `write` weighs these.
class VertexImageMaker final : public ImageMaker {
  public:
    // `colours` are of the material's lobes. Keeps a reference to the surface.
    VertexImageMaker(const SeenSurface& surface,
                     std::shared_ptr<const served::Scene> scene,
                     std::vector<Imath::V3f> colours);

    bool look(const view::Look& look) override;
    [[nodiscard]] std::vector<float> block_weights() const override {
        return view_->block_weights();
    }
    std::uint64_t take(std::span<const float> sums) override;
    // 3 values a vertex, in the order of SeenSurface::seen_from.
    void write(std::span<float> rgb) override;

    // Of the last `write`.
    [[nodiscard]] double write_seconds() const { return write_seconds_; }

  private:
    void weigh_terms();

    const SeenSurface& surface_;
    std::shared_ptr<const served::Scene> scene_;
    std::vector<Imath::V3f> colours_;
    std::unique_ptr<view::View> view_;
    view::VertexRadiance radiance_;
    std::uint32_t terms_;
    Imath::V3f eye_{0, 0, 0};
    std::vector<SeenVertex> seen_;
    std::vector<Imath::V3f> weights_;  // [seen][terms]
    bool has_moved_ = true;
    double write_seconds_ = 0;
};

}  // namespace relume::lab
