// From the sums of a session to the image of a scene.
#pragma once

#include "server/scene/scene.h"
#include "server/view/view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::lab {

// Not thread-safe.
class ImageMaker {
  public:
    ImageMaker() = default;
    ImageMaker(const ImageMaker&) = delete;
    ImageMaker& operator=(const ImageMaker&) = delete;
    ImageMaker(ImageMaker&&) = delete;
    ImageMaker& operator=(ImageMaker&&) = delete;
    virtual ~ImageMaker() = default;

    // Where the next images are looked at from. Returns whether anything has changed.
    virtual bool look(const view::Look& look) = 0;
    // How much each block of the sums counts in what is looked at
    // (engine::Session::set_block_weights); empty where all count alike.
    [[nodiscard]] virtual std::vector<float> block_weights() const = 0;

    // From sums, [blocks][3][256], to what the receivers have of the light. This is part of the
    // method's time. Returns the bytes read for it. The sums must stay until the image is
    // written.
    virtual std::uint64_t take(std::span<const float> sums) = 0;
    // The image of the sums taken last, interleaved RGB, 3·width·height values.
    virtual void write(std::span<float> rgb) = 0;
};

// A view of the scene as the server has it. Of a surface, its vertices' radiance is what `take`
// makes; pixels of one camera are made when the image is written.
class ViewImageMaker final : public ImageMaker {
  public:
    explicit ViewImageMaker(const served::Scene& scene) : view_(scene.make_view()) {}

    bool look(const view::Look& look) override { return view_->look(look); }
    [[nodiscard]] std::vector<float> block_weights() const override {
        return view_->block_weights();
    }
    std::uint64_t take(std::span<const float> sums) override;
    void write(std::span<float> rgb) override { view::write_image(*view_, sums_, rgb); }

  private:
    std::unique_ptr<view::View> view_;
    std::span<const float> sums_;
};

}  // namespace relume::lab
