// The whole picture: the relit image over what lies behind the scene.
#pragma once

#include "protocol/light/light_rig.h"
#include "protocol/wire/half_image.h"
#include "protocol/wire/room_state.h"
#include "server/net/images/display_table.h"
#include "server/net/images/sky_pixels.h"
#include "server/view/view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::net {

// Goes through the image a few tiles at a time, from sums to what is encoded, so that pixels in
// between stay in the cache. Not thread-safe; spreads its work over oneTBB.
class FrameComposer {
  public:
    // `sky`: of the view as it is; null where it is still to be found.
    FrameComposer(std::unique_ptr<view::View> view, std::shared_ptr<const SkyPixels> sky);

    // Of the picture composed last.
    [[nodiscard]] std::uint32_t width() const { return image_.width; }
    [[nodiscard]] std::uint32_t height() const { return image_.height; }

    // As the view does. Where it returns true, the background has to be set again.
    bool look(const view::Look& look);
    bool look_closer();
    // Of the view as it is looked at.
    [[nodiscard]] std::vector<float> block_weights() const { return view_->block_weights(); }
    [[nodiscard]] const view::View& view() const { return *view_; }
    // The sums of the next picture are not those of the picture before.
    void sums_have_changed() { view_->sums_have_changed(); }

    // Sets what shows behind the scene. In mode `environment` the rig is looked up at its full
    // resolution, once for each pixel that sees it; in other modes it is not used.
    void set_background(const wire::Background& background, const light::LightRig& rig);
    [[nodiscard]] bool has_alpha() const { return has_alpha_; }

    // Puts the view's image of the sums over the background. Makes code values for a JPEG of
    // each display, over black where the background is transparent. Where `half_planes` is set,
    // it also makes linear radiance in half floats, premultiplied where transparent.
    void compose(std::span<const float> sums,
                 std::span<const DisplayTable* const> displays,
                 bool half_planes);
    // Code values of the last `compose` for one of its displays: interleaved, row by row from
    // the top, 3·width·height.
    [[nodiscard]] std::span<const std::uint8_t> codes(std::size_t display) const {
        return codes_[display];
    }
    [[nodiscard]] const wire::HalfImage& half_image() const { return half_; }

  private:
    template <typename Take>
    void for_each_row(std::span<const float> sums, const Take& take) const;
    // Pixels from `index` on.
    void put_half(std::size_t index, std::span<const float> rgb);
    // To the pixels of a row from x on.
    void add_background(std::uint32_t x, std::uint32_t y, std::span<float> rgb) const;

    const std::unique_ptr<view::View> view_;
    std::shared_ptr<const SkyPixels> sky_;
    transport::TileGrid image_;
    bool has_alpha_ = false;
    std::vector<Imath::V3f> background_;  // of every sky pixel, times its visible part
    std::vector<std::vector<std::uint8_t>> codes_;
    wire::HalfImage half_;
};

}  // namespace relume::net
