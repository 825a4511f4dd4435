#include "precompute/bake/rows/tile_window.h"

#include "protocol/base/program/usage.h"
#include "protocol/transport/receiver_layout.h"

#include <fmt/format.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace relume::bake {

TileWindow::TileWindow(const RayCaster& caster,
                       const scene::Camera& camera,
                       const BakeParameters& parameters)
    : TileWindow(caster, camera, parameters, {.left = 0, .right = camera.width()}) {
    // The tallest window: the tile rows of a shard and the pool's reach on both sides.
    const std::uint32_t tiles_x =
        transport::TileGrid{camera.width(), camera.height()}.tiles_x();
    const std::uint32_t tile_rows =
        std::max(1U, transport::kMaxBlocksPerShard / std::max(tiles_x, 1U));
    const std::uint64_t rows = std::min(std::uint64_t{tile_rows} * transport::kTileSide +
                                            2 * std::uint64_t{parameters.pool_radius},
                                        std::uint64_t{camera.height()});
    const std::uint64_t bytes =
        rows * camera.width() * PathTracer::most_bytes(parameters.bounces, parameters.samples);
    if (parameters.bounces > 0 && bytes > kMaxPathBytes) {
        throw program::UsageError(fmt::format(
            "samples is {}: {} rows of {} pixels would keep {} MiB of paths, expected at most "
            "{} MiB; take fewer samples, a smaller pool or a narrower image",
            parameters.samples, rows, camera.width(), bytes >> 20U, kMaxPathBytes >> 20U));
    }
}

TileWindow::TileWindow(const RayCaster& caster,
                       const scene::Camera& camera,
                       const BakeParameters& parameters,
                       const PixelColumns& columns)
    : caster_(caster),
      camera_(camera),
      parameters_(parameters),
      tracer_(caster,
              parameters.face_resolution,
              parameters.bounces,
              parameters.samples,
              parameters.seed) {
    const std::uint32_t reach = pool_reach();
    columns_ = {.left = columns.left > reach ? columns.left - reach : 0,
                .right = std::min(columns.right + reach, camera.width())};
}

std::uint64_t TileWindow::move_to(std::uint32_t first, std::uint32_t last) {
    const std::uint32_t reach = pool_reach();
    const std::uint32_t top = first > reach ? first - reach : 0;
    const std::uint32_t end = std::min(last + reach, camera_.height());
    if (rows_.empty() || top >= bottom()) {
        rows_.clear();
        top_ = top;
    }
    for (; top_ < top; ++top_) {
        rows_.pop_front();
    }
    const std::uint32_t missing = bottom();
    for (std::uint32_t y = missing; y < end; ++y) {
        rows_.emplace_back(columns_.right - columns_.left);
    }
    if (missing >= end) {
        return 0;
    }
    std::atomic<std::uint64_t> rays = 0;
    tbb::parallel_for(
        tbb::blocked_range2d<std::uint32_t>(missing, end, 4, columns_.left, columns_.right, 16),
        [&](const tbb::blocked_range2d<std::uint32_t>& range) {
            std::uint64_t cast = 0;
            for (std::uint32_t y = range.rows().begin(); y != range.rows().end(); ++y) {
                for (std::uint32_t x = range.cols().begin(); x != range.cols().end(); ++x) {
                    TracedPixel& pixel = rows_[y - top_][x - columns_.left];
                    pixel = trace(x, y);
                    for (const SurfacePaths& paths : pixel.paths) {
                        cast += paths.rays;
                    }
                }
            }
            rays += cast;
        });
    return rays;
}

std::uint32_t TileWindow::pool_reach() const {
    return parameters_.bounces > 0 ? parameters_.pool_radius : 0;
}

std::size_t TileWindow::surface_count(std::uint32_t x, std::uint32_t y) const {
    return view_pixel(caster_, camera_, x, y, parameters_.pixel_samples, parameters_.seed)
        .surfaces.size();
}

TracedPixel TileWindow::trace(std::uint32_t x, std::uint32_t y) const {
    TracedPixel pixel;
    pixel.view =
        view_pixel(caster_, camera_, x, y, parameters_.pixel_samples, parameters_.seed);
    if (parameters_.bounces > 0) {
        for (std::uint32_t i = 0; i < pixel.view.surfaces.size(); ++i) {
            pixel.paths.push_back(tracer_.trace(pixel.view.surfaces[i], i, x, y));
        }
    }
    return pixel;
}

}  // namespace relume::bake
