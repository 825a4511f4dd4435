// The rows of pixels a bake is working on: what they see and the paths from there.
//
// Shards are baked in order, and a pixel shares the paths of its neighbours, so some rows above
// and below the current ones are kept. Each row is traced once and dropped when the bake has
// passed it: memory does not grow with the image's height.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/receivers/receiver.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/scene/camera.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace relume::bake {

// Columns of pixels [left, right).
struct PixelColumns {
    std::uint32_t left = 0;
    std::uint32_t right = 0;
};

struct TracedPixel {
    PixelView view;
    std::vector<SurfacePaths> paths;  // one per surface; none when the bake has no bounces
};

class TileWindow {
  public:
    // Whole rows. Throws BakeError when the paths that pooling keeps could pass kMaxPathBytes.
    TileWindow(const RayCaster& caster,
               const scene::Camera& camera,
               const BakeParameters& parameters);
    // A part of every row: these columns and those within the pool radius of them.
    TileWindow(const RayCaster& caster,
               const scene::Camera& camera,
               const BakeParameters& parameters,
               const PixelColumns& columns);

    static constexpr std::uint64_t kMaxPathBytes = std::uint64_t{2} << 30U;

    // Traces, in parallel, what is missing of pixel rows [first, last) and of those within the
    // pool radius of them; forgets the rows above. `first` never decreases. Returns the rays
    // cast.
    std::uint64_t move_to(std::uint32_t first, std::uint32_t last);

    // A pixel of the rows in reach. Thread-safe while move_to does not run.
    [[nodiscard]] const TracedPixel& pixel(std::uint32_t x, std::uint32_t y) const {
        return rows_[y - top_][x - columns_.left];
    }
    // Columns in reach.
    [[nodiscard]] const PixelColumns& columns() const { return columns_; }
    // Rows in reach are [top, bottom).
    [[nodiscard]] std::uint32_t top() const { return top_; }
    [[nodiscard]] std::uint32_t bottom() const {
        return top_ + static_cast<std::uint32_t>(rows_.size());
    }

    // Surfaces that are seen in the pixel.
    [[nodiscard]] std::size_t surface_count(std::uint32_t x, std::uint32_t y) const;
    // One pixel, traced by itself.
    [[nodiscard]] TracedPixel trace(std::uint32_t x, std::uint32_t y) const;

  private:
    // Pixels around a pixel whose paths it may share.
    [[nodiscard]] std::uint32_t pool_reach() const;

    const RayCaster& caster_;
    const scene::Camera& camera_;
    BakeParameters parameters_;
    PixelColumns columns_;
    PathTracer tracer_;
    std::deque<std::vector<TracedPixel>> rows_;
    std::uint32_t top_ = 0;
};

}  // namespace relume::bake
