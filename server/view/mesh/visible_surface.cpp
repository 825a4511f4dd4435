#include "server/view/mesh/visible_surface.h"

#include "server/view/mesh/surface_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace relume::view {

// Calls take(x, y, point, nearness) for every pixel of a tile.
template <typename Take>
void VisibleSurface::draw_tile(std::uint32_t tile,
                               const SamplePosition& sample,
                               const Take& take) const {
    thread_local RasterTile raster;
    const std::uint32_t left = tile % bins_.tiles_x() * kRasterSide;
    const std::uint32_t top = tile / bins_.tiles_x() * kRasterSide;
    raster.clear();
    bins_.for_each_part(tile, [&](std::span<const ProjectedTriangle> triangles,
                                  std::span<const std::uint32_t> numbers) {
        draw(triangles, numbers, left, top, sample, raster);
    });
    if (holes_ != nullptr) {
        holed_bins_.for_each_part(tile, [&](std::span<const ProjectedTriangle> triangles,
                                            std::span<const std::uint32_t> numbers) {
            draw_with_holes(triangles, numbers, left, top, sample, *holes_, raster);
        });
    }
    for (std::uint32_t y = 0; y < std::min(kRasterSide, height_ - top); ++y) {
        for (std::uint32_t x = 0; x < std::min(kRasterSide, width_ - left); ++x) {
            const std::size_t at = std::size_t{y} * RasterTile::kRow + x;
            take(left + x, top + y,
                 SurfacePoint{.triangle = raster.triangle[at],
                              .weight_1 = raster.weight_1[at],
                              .weight_2 = raster.weight_2[at]},
                 raster.nearness[at]);
        }
    }
}

SamplePosition VisibleSurface::position_of_sample(std::size_t sample) {
    // Four bits reversed: every row and every column of sixteenths has one place.
    const std::size_t reversed =
        (sample & 1) << 3 | (sample & 2) << 1 | (sample & 4) >> 1 | (sample & 8) >> 3;
    return {(static_cast<double>(sample) + 0.5) / kSamplesOfEdge,
            (static_cast<double>(reversed) + 0.5) / kSamplesOfEdge};
}

void VisibleSurface::look(const transport::SurfaceMesh& mesh,
                          const Pinhole& pinhole,
                          std::uint32_t width,
                          std::uint32_t height,
                          const Holes* holes) {
    width_ = width;
    height_ = height;
    holes_ = holes != nullptr && holes->is_anywhere() ? holes : nullptr;
    const PixelSpace space(pinhole, width, height);
    if (holes_ == nullptr) {
        bins_.fill(mesh, space, width, height);
        holed_bins_.clear();
    } else {
        std::vector<std::uint8_t> is_holed;
        std::vector<std::uint8_t> is_whole;
        for (std::uint32_t material = 0; material < holes_->material_count(); ++material) {
            is_holed.push_back(holes_->are_in(material) ? 1 : 0);
            is_whole.push_back(holes_->are_in(material) ? 0 : 1);
        }
        bins_.fill(mesh, space, width, height, is_whole);
        holed_bins_.fill(mesh, space, width, height, is_holed);
    }
    const std::size_t pixels = std::size_t{width} * height;
    points_.resize(pixels);
    nearness_.resize(pixels);
    edges_.clear();
    edge_of_pixel_.clear();
    edge_points_.clear();
    tbb::parallel_for(std::uint32_t{0}, bins_.tiles_x() * bins_.tiles_y(),
                      [&](std::uint32_t tile) {
                          draw_tile(tile, {},
                                    [&](std::uint32_t x, std::uint32_t y,
                                        const SurfacePoint& point, float nearness) {
                                        const std::size_t pixel = std::size_t{y} * width_ + x;
                                        points_[pixel] = point;
                                        nearness_[pixel] = nearness;
                                    });
                      });
}

void VisibleSurface::add_edges_of_holes(const transport::SurfaceMesh& mesh) {
    // Of the sixteen places four that lie one in each quarter of a pixel.
    constexpr std::array<std::size_t, 4> kSamples{2, 7, 8, 13};
    const auto material_of = [&mesh](const SurfacePoint& point) {
        return point.triangle == kNoTriangle ? kNoTriangle
                                             : mesh.triangles[point.triangle].material;
    };
    std::vector<std::uint8_t> is_edge(points_.size(), 0);
    for (const std::uint32_t pixel : edges_) {
        is_edge[pixel] = 1;
    }
    const std::uint32_t tiles = holed_bins_.tiles_x() * holed_bins_.tiles_y();
    tbb::parallel_for(std::uint32_t{0}, tiles, [&](std::uint32_t tile) {
        if (!holed_bins_.has_any(tile)) {
            return;
        }
        for (const std::size_t sample : kSamples) {
            draw_tile(tile, position_of_sample(sample),
                      [&](std::uint32_t x, std::uint32_t y, const SurfacePoint& point,
                          float /*nearness*/) {
                          const std::size_t pixel = std::size_t{y} * width_ + x;
                          if (material_of(point) != material_of(points_[pixel])) {
                              is_edge[pixel] = 1;
                          }
                      });
        }
    });
    edges_.clear();
    for (std::size_t pixel = 0; pixel < is_edge.size(); ++pixel) {
        if (is_edge[pixel] != 0) {
            edges_.push_back(static_cast<std::uint32_t>(pixel));
        }
    }
}

void VisibleSurface::look_at_edges(const transport::SurfaceMesh& mesh) {
    edges_ = pixels_of_edges(mesh, points_, nearness_, width_, height_);
    if (holes_ != nullptr) {
        add_edges_of_holes(mesh);
    }
    edge_of_pixel_.assign(points_.size(), kNoEdge);
    std::vector<bool> has_edges(std::size_t{bins_.tiles_x()} * bins_.tiles_y(), false);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        edge_of_pixel_[edges_[i]] = static_cast<std::uint32_t>(i);
        const std::uint32_t x = edges_[i] % width_;
        const std::uint32_t y = edges_[i] / width_;
        has_edges[y / kRasterSide * bins_.tiles_x() + x / kRasterSide] = true;
    }
    edge_points_.resize(edges_.size() * kSamplesOfEdge);
    tbb::parallel_for(std::size_t{0}, has_edges.size(), [&](std::size_t tile) {
        if (!has_edges[tile]) {
            return;
        }
        for (std::size_t sample = 0; sample < kSamplesOfEdge; ++sample) {
            draw_tile(static_cast<std::uint32_t>(tile), position_of_sample(sample),
                      [&](std::uint32_t x, std::uint32_t y, const SurfacePoint& point,
                          float /*nearness*/) {
                          const std::uint32_t edge =
                              edge_of_pixel_[std::size_t{y} * width_ + x];
                          if (edge != kNoEdge) {
                              edge_points_[edge * kSamplesOfEdge + sample] = point;
                          }
                      });
        }
    });
}

}  // namespace relume::view
