// The image of one fixed camera, whose pixels are the receivers.
#pragma once

#include "protocol/transport/transport.h"
#include "server/view/view.h"

#include <cstdint>
#include <memory>
#include <span>

namespace relume::view {

// Receivers are pixels, and a block is a tile of 16×16 of them. Nothing of it changes.
class ImageView final : public View {
  public:
    explicit ImageView(std::shared_ptr<const transport::Transport> transport);

    bool look(const Look& /*look*/) override { return false; }
    bool look_closer() override { return false; }

    [[nodiscard]] const transport::TileGrid& image() const override {
        return transport_->manifest().image();
    }
    [[nodiscard]] const transport::CameraRecord& camera() const override {
        return transport_->manifest().camera;
    }
    void write_coverage(std::span<float> coverage) const override;

    void begin_image(std::span<const float> /*sums*/) override {}
    void write_tiles(std::span<const float> sums,
                     const TileRun& tiles,
                     std::span<float> rgb) const override;

  private:
    void write_block(std::span<const float> sums,
                     std::uint32_t block,
                     const PixelRect& pixels,
                     std::span<float> rgb) const;

    std::shared_ptr<const transport::Transport> transport_;
};

}  // namespace relume::view
