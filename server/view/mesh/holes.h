// Where materials of a surface have holes, which show what lies behind.
#pragma once

#include "protocol/transport/surface.h"
#include "server/view/mesh/projected_triangle.h"
#include "server/view/mesh/raster_tile.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace relume::view {

// Immutable; safe to share between threads.
class Holes {
  public:
    Holes(std::shared_ptr<const transport::Surface> surface,
          std::span<const transport::MaterialRecord> materials);

    [[nodiscard]] bool is_anywhere() const { return is_anywhere_; }
    [[nodiscard]] std::uint32_t material_count() const {
        return static_cast<std::uint32_t>(cutouts_.size());
    }
    [[nodiscard]] bool are_in(std::uint32_t material) const {
        return cutouts_[material].has_value();
    }
    // Of a triangle whose material has holes; the weights are of its second and third corner.
    [[nodiscard]] bool is_solid_at(std::uint32_t triangle,
                                   float weight_1,
                                   float weight_2) const;

  private:
    std::shared_ptr<const transport::Surface> surface_;
    std::vector<std::optional<transport::CutoutRecord>> cutouts_;  // by material
    bool is_anywhere_ = false;
};

// As draw (raster_tile.h), of triangles whose materials have holes: only where they are solid.
void draw_with_holes(std::span<const ProjectedTriangle> triangles,
                     std::span<const std::uint32_t> numbers,
                     std::uint32_t left,
                     std::uint32_t top,
                     const SamplePosition& sample,
                     const Holes& holes,
                     RasterTile& tile);

}  // namespace relume::view
