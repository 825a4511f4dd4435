// The whole picture: the relit image over what lies behind the scene.
#pragma once

#include "protocol/wire/half_image.h"
#include "protocol/wire/session_state.h"
#include "server/engine/session.h"
#include "server/light/light_rig.h"
#include "server/net/display_table.h"
#include "server/net/sky_pixels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::net {

// Linear radiance, premultiplied where transparent. Not thread-safe; spreads its work over
// oneTBB.
class FrameComposer {
  public:
    FrameComposer(const SkyPixels& sky, std::uint32_t width, std::uint32_t height);

    // What is behind the scene from now on. The rig is looked up only in mode `environment`, at
    // its full resolution, once per pixel that sees it.
    void set_background(const wire::Background& background, const light::LightRig& rig);

    // Puts session's image and background together.
    void compose(const engine::Session& session);

    // Of the last `compose`: interleaved, row by row from the top, 3·width·height.
    [[nodiscard]] std::span<const float> rgb() const { return rgb_; }
    [[nodiscard]] bool has_alpha() const { return has_alpha_; }
    // Code values for a JPEG, over black where transparent.
    void write_codes(const DisplayTable& table, std::span<std::uint8_t> codes) const;
    [[nodiscard]] const wire::HalfImage& half_image();

  private:
    const SkyPixels& sky_;
    std::uint32_t width_;
    std::uint32_t height_;
    bool has_alpha_ = false;
    std::vector<Imath::V3f> background_;  // of every sky pixel, times its visible part
    std::vector<float> rgb_;
    wire::HalfImage half_;
};

}  // namespace relume::net
