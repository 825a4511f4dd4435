#include "server/view/mesh/holes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::view {
namespace {

struct PixelRange {
    std::uint32_t first;
    std::uint32_t end;
};

// Those whose samples, at `begin` + i, lie between the bounds.
PixelRange pixels_between(double lower, double upper, double begin) {
    return {static_cast<std::uint32_t>(
                std::clamp(std::ceil(lower - begin), 0.0, double{kRasterSide})),
            static_cast<std::uint32_t>(
                std::clamp(std::floor(upper - begin) + 1, 0.0, double{kRasterSide}))};
}

void draw_triangle(const ProjectedTriangle& triangle,
                   double begin_x,
                   double begin_y,
                   const Holes& holes,
                   RasterTile& tile) {
    const PixelRange columns = pixels_between(triangle.left, triangle.right, begin_x);
    const PixelRange rows = pixels_between(triangle.top, triangle.bottom, begin_y);
    for (std::uint32_t y = rows.first; y < rows.end; ++y) {
        for (std::uint32_t x = columns.first; x < columns.end; ++x) {
            const double at_x = begin_x + x;
            const double at_y = begin_y + y;
            const double weight_0 = triangle.edges[0].at(at_x, at_y);
            const double weight_1 = triangle.edges[1].at(at_x, at_y);
            const double weight_2 = triangle.edges[2].at(at_x, at_y);
            if (std::min({weight_0, weight_1, weight_2}) < 0) {
                continue;
            }
            const double sum = weight_0 + weight_1 + weight_2;
            const auto nearness = static_cast<float>(sum * triangle.nearness_of_weight);
            const std::size_t at = y * RasterTile::kRow + x;
            if (!(nearness > tile.nearness[at])) {
                continue;
            }
            const auto share_1 = static_cast<float>(weight_1 / sum);
            const auto share_2 = static_cast<float>(weight_2 / sum);
            if (holes.is_solid_at(triangle.triangle, share_1, share_2)) {
                tile.nearness[at] = nearness;
                tile.triangle[at] = triangle.triangle;
                tile.weight_1[at] = share_1;
                tile.weight_2[at] = share_2;
            }
        }
    }
}

}  // namespace

Holes::Holes(std::shared_ptr<const transport::Surface> surface,
             std::span<const transport::MaterialRecord> materials)
    : surface_(std::move(surface)) {
    for (const transport::MaterialRecord& material : materials) {
        cutouts_.push_back(material.cutout);
        is_anywhere_ = is_anywhere_ || material.cutout.has_value();
    }
}

bool Holes::is_solid_at(std::uint32_t triangle, float weight_1, float weight_2) const {
    const std::uint32_t material = surface_->mesh.triangles[triangle].material;
    return transport::is_solid_at(*surface_, *cutouts_[material], triangle, weight_1, weight_2);
}

void draw_with_holes(std::span<const ProjectedTriangle> triangles,
                     std::span<const std::uint32_t> numbers,
                     std::uint32_t left,
                     std::uint32_t top,
                     const SamplePosition& sample,
                     const Holes& holes,
                     RasterTile& tile) {
    for (const std::uint32_t number : numbers) {
        draw_triangle(triangles[number], left + sample.x, top + sample.y, holes, tile);
    }
}

}  // namespace relume::view
