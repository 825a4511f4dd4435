// What is added to the tiles of an image beside the sums of its receivers.
#pragma once

#include "protocol/transport/format.h"
#include "server/view/view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace relume::view {

class TileAddend {
  public:
    TileAddend() = default;
    TileAddend(const TileAddend&) = delete;
    TileAddend& operator=(const TileAddend&) = delete;
    virtual ~TileAddend() = default;

    // Adds to the pixels of a tile, which begin at `first` of an image whose rows are
    // `row_floats` apart: interleaved RGB, of pixels that the image has. Any number of threads
    // may add at a time.
    virtual void add_to_tile(std::uint32_t tile,
                             float* first,
                             std::size_t row_floats) const = 0;
};

// A view with something added.
class AddedView final : public View {
  public:
    // The addend outlives the view.
    AddedView(std::unique_ptr<View> view, const TileAddend& addend)
        : view_(std::move(view)), addend_(addend) {}

    bool look(const Look& look) override { return view_->look(look); }
    bool look_closer() override { return view_->look_closer(); }
    [[nodiscard]] const transport::TileGrid& image() const override { return view_->image(); }
    [[nodiscard]] const transport::CameraRecord& camera() const override {
        return view_->camera();
    }
    void write_coverage(std::span<float> coverage) const override {
        view_->write_coverage(coverage);
    }
    [[nodiscard]] std::vector<float> block_weights() const override {
        return view_->block_weights();
    }
    [[nodiscard]] SeenVertices seen_vertices() const override {
        return view_->seen_vertices();
    }
    void sums_have_changed() override { view_->sums_have_changed(); }
    void begin_image(std::span<const float> sums) override { view_->begin_image(sums); }
    void write_tiles(std::span<const float> sums,
                     const TileRun& tiles,
                     std::span<float> rgb) const override {
        view_->write_tiles(sums, tiles, rgb);
        const std::size_t row_floats = std::size_t{3} * pixels_of(image(), tiles).width;
        for (std::uint32_t tile = tiles.first; tile < tiles.last; ++tile) {
            const std::size_t left = std::size_t{tile - tiles.first} * transport::kTileSide;
            addend_.add_to_tile(tiles.row * image().tiles_x() + tile, &rgb[3 * left],
                                row_floats);
        }
    }

  private:
    std::unique_ptr<View> view_;
    const TileAddend& addend_;
};

}  // namespace relume::view
