// The whole picture: the relit image over what lies behind the scene.
#pragma once

#include "protocol/wire/half_image.h"
#include "protocol/wire/room_state.h"
#include "server/light/light_rig.h"
#include "server/net/images/display_table.h"
#include "server/net/images/sky_pixels.h"
#include "server/view/image_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::net {

// Goes through the image a few tiles at a time, from sums to what is encoded, so that pixels in
// between stay in the cache. Not thread-safe; spreads its work over oneTBB.
class FrameComposer {
  public:
    // Keeps references to both, which are of one scene.
    FrameComposer(const view::ImageView& view, const SkyPixels& sky);

    // Of every picture: nobody else is asked for it.
    [[nodiscard]] std::uint32_t width() const { return image_.width; }
    [[nodiscard]] std::uint32_t height() const { return image_.height; }

    // What is behind the scene from now on. The rig is looked up only in mode `environment`, at
    // its full resolution, once per pixel that sees it.
    void set_background(const wire::Background& background, const light::LightRig& rig);
    [[nodiscard]] bool has_alpha() const { return has_alpha_; }

    // Puts the view's image of the sums and the background together: as code values for a JPEG of each
    // display, over black where transparent; and, where `half_planes`, as linear radiance in
    // half floats, premultiplied where transparent.
    void compose(std::span<const float> sums,
                 std::span<const DisplayTable* const> displays,
                 bool half_planes);
    // Of the last `compose`, display by display: interleaved, row by row from the top,
    // 3·width·height.
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

    const view::ImageView& view_;
    const SkyPixels& sky_;
    const transport::TileGrid image_;
    bool has_alpha_ = false;
    std::vector<Imath::V3f> background_;  // of every sky pixel, times its visible part
    std::vector<std::vector<std::uint8_t>> codes_;
    wire::HalfImage half_;
};

}  // namespace relume::net
