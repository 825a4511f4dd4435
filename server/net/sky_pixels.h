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

// Pixels of one row side by side.
struct SkyRun {
    std::uint32_t x = 0;  // of the first
    std::uint32_t count = 0;
    std::uint32_t place = 0;  // of the first in pixels()
};

// Immutable; shared by all rooms of a scene.
class SkyPixels {
  public:
    explicit SkyPixels(const transport::Transport& transport);

    // By index.
    [[nodiscard]] std::span<const SkyPixel> pixels() const { return pixels_; }
    // The same, of a row from left to right.
    [[nodiscard]] std::span<const SkyRun> runs_of_row(std::uint32_t y) const {
        return std::span(runs_).subspan(row_begins_[y], row_begins_[y + 1] - row_begins_[y]);
    }
    // Of every pixel, row by row from the top, in [0, 1].
    [[nodiscard]] std::span<const float> coverage() const { return coverage_; }

  private:
    void append(const SkyPixel& pixel, std::uint32_t x);

    std::vector<SkyPixel> pixels_;
    std::vector<SkyRun> runs_;
    std::vector<std::size_t> row_begins_;  // [height + 1], in runs_
    std::vector<float> coverage_;
};

}  // namespace relume::net
