// What of a surface mesh shows in an image: which triangle, and where on it.
#pragma once

#include "protocol/transport/surface_mesh.h"
#include "server/view/mesh/holes.h"
#include "server/view/mesh/pixel_space.h"
#include "server/view/mesh/raster_tile.h"
#include "server/view/mesh/triangle_bins.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

// A point of the mesh: a triangle, and the weights of its second and third corner; that of the
// first is what they leave of 1. Perspective is in the weights.
struct SurfacePoint {
    std::uint32_t triangle = kNoTriangle;  // or nothing is there
    float weight_1 = 0;
    float weight_2 = 0;

    friend bool operator==(const SurfacePoint&, const SurfacePoint&) = default;
};

// A triangle shows its front alone, and holes show what lies behind them. A pixel shows what is
// nearest in its middle; at rest, pixels in which different things meet show what is nearest in
// sixteen places. Not
// thread-safe, but for what is const; memory stays from one look to the next.
class VisibleSurface {
  public:
    static constexpr std::size_t kSamplesOfEdge = 16;

    // What shows in the middle of every pixel. `holes` are the mesh's own, or null where it has
    // none; kept until the next look. Spread over the caller's arena.
    void look(const transport::SurfaceMesh& mesh,
              const Pinhole& pinhole,
              std::uint32_t width,
              std::uint32_t height,
              const Holes* holes = nullptr);
    // Looks closer at the pixels in which different things meet.
    void look_at_edges(const transport::SurfaceMesh& mesh);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    // In the middle of a pixel.
    [[nodiscard]] const SurfacePoint& point(std::uint32_t x, std::uint32_t y) const {
        return points_[std::size_t{y} * width_ + x];
    }
    // One over its depth along forward; 0 where nothing is there.
    [[nodiscard]] float nearness(std::uint32_t x, std::uint32_t y) const {
        return nearness_[std::size_t{y} * width_ + x];
    }
    // The points of a pixel: one, or those of its sixteen places.
    [[nodiscard]] std::span<const SurfacePoint> points(std::uint32_t x, std::uint32_t y) const {
        const std::size_t pixel = std::size_t{y} * width_ + x;
        if (!edge_of_pixel_.empty() && edge_of_pixel_[pixel] != kNoEdge) {
            return std::span(edge_points_)
                .subspan(std::size_t{edge_of_pixel_[pixel]} * kSamplesOfEdge, kSamplesOfEdge);
        }
        return {&points_[pixel], 1};
    }
    [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }
    // Where in a pixel its sixteen places lie.
    [[nodiscard]] static SamplePosition position_of_sample(std::size_t sample);

  private:
    static constexpr std::uint32_t kNoEdge = kNoTriangle;

    template <typename Take>
    void draw_tile(std::uint32_t tile, const SamplePosition& sample, const Take& take) const;
    // Pixels in which a hole begins or ends, whatever shows in their middles.
    void add_edges_of_holes(const transport::SurfaceMesh& mesh);

    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    const Holes* holes_ = nullptr;
    TriangleBins bins_;                         // of materials without holes
    TriangleBins holed_bins_;                   // of the others
    std::vector<SurfacePoint> points_;          // [height][width]
    std::vector<float> nearness_;               // [height][width]
    std::vector<std::uint32_t> edges_;          // pixels, in their order
    std::vector<std::uint32_t> edge_of_pixel_;  // empty until edges are looked at
    std::vector<SurfacePoint> edge_points_;     // [edges][16]
};

}  // namespace relume::view
