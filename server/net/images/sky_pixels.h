// The pixels of a view through which the environment is seen directly.
#pragma once

#include "protocol/light/lat_long_kernel.h"
#include "server/view/view.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::net {

// Some of these pixels, in the order of the image, in the form in which they are looked up.
struct SkyLooks {
    light::LookDirections directions;    // unit, in the world, through the pixels' centres
    light::LookNumbers footprints_sr{};  // solid angles of the pixels
    light::LookNumbers visible{};        // 1 − coverage, in (0, 1]
    std::uint32_t count = 0;             // kLooksPerRun, but for the last
};

// Neighbouring such pixels of one row.
struct SkyRun {
    std::uint32_t x = 0;  // of the first
    std::uint32_t count = 0;
    std::uint32_t place = 0;  // of the first one, among all sky pixels
};

// Immutable; rooms of a scene whose view is fixed share one.
class SkyPixels {
  public:
    // Of the view as it is. Spread over the caller's arena.
    explicit SkyPixels(const view::View& view);

    // Row by row from the top.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::span<const SkyLooks> looks() const { return looks_; }
    // The same, of a row from left to right.
    [[nodiscard]] std::span<const SkyRun> runs_of_row(std::uint32_t y) const {
        return std::span(runs_).subspan(row_begins_[y], row_begins_[y + 1] - row_begins_[y]);
    }
    // Of every pixel, row by row from the top, in [0, 1].
    [[nodiscard]] std::span<const float> coverage() const { return coverage_; }

  private:
    [[nodiscard]] std::span<const float> coverage_of_row(std::uint32_t y) const {
        return std::span(coverage_).subspan(std::size_t{y} * image_.width, image_.width);
    }
    // `place`: of the row's first sky pixel.
    void fill_row(const transport::CameraRecord& camera, std::uint32_t y, std::size_t place);

    transport::TileGrid image_;
    std::size_t size_ = 0;
    std::vector<SkyLooks> looks_;
    std::vector<SkyRun> runs_;
    std::vector<std::size_t> row_begins_;  // [height + 1], in runs_
    std::vector<float> coverage_;
};

}  // namespace relume::net
