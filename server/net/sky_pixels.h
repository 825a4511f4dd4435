// The pixels of a scene through which the environment is seen directly.
#pragma once

#include "protocol/transport/transport.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

namespace relume::net {

struct SkyPixel {
    std::uint32_t index = 0;  // y·width + x
    float visible = 1;        // 1 − coverage, in (0, 1]
    Imath::V3f direction;     // unit, in the world, through the pixel's centre
    float footprint_sr = 0;   // solid angle of the pixel
};

// Immutable; shared by all rooms of a scene.
class SkyPixels {
  public:
    explicit SkyPixels(const transport::Transport& transport);

    [[nodiscard]] std::span<const SkyPixel> pixels() const { return pixels_; }
    // Of every pixel, row by row from the top, in [0, 1].
    [[nodiscard]] std::span<const float> coverage() const { return coverage_; }

  private:
    std::vector<SkyPixel> pixels_;
    std::vector<float> coverage_;
};

}  // namespace relume::net
