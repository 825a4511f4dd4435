// The triangles that may show in each tile of an image.
#pragma once

#include "protocol/transport/surface_mesh.h"
#include "server/view/mesh/pixel_space.h"
#include "server/view/mesh/projected_triangle.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

// Tiles are squares of kRasterSide pixels, row by row from the top left. Memory stays from one
// image to the next. Not thread-safe, but for what is const.
class TriangleBins {
  public:
    // Projects all triangles, and says which tiles each may show in. `is_in` says of every
    // material whether its triangles are among them; empty where all are. Spread over the
    // caller's arena; what comes out does not depend on the threads.
    void fill(const transport::SurfaceMesh& mesh,
              const PixelSpace& space,
              std::uint32_t width,
              std::uint32_t height,
              std::span<const std::uint8_t> is_in = {});
    // No triangles, of an image without a tile.
    void clear();
    [[nodiscard]] bool has_any(std::uint32_t tile) const;

    [[nodiscard]] std::uint32_t tiles_x() const { return tiles_x_; }
    [[nodiscard]] std::uint32_t tiles_y() const { return tiles_y_; }

    // Calls draw(triangles, numbers of some of them) for the triangles of a tile: all in the
    // order of the mesh.
    template <typename Draw>
    void for_each_part(std::uint32_t tile, const Draw& draw) const {
        for (const Chunk& chunk : chunks_) {
            const std::uint32_t begin = chunk.begins[tile];
            const std::uint32_t end = chunk.begins[tile + 1];
            if (begin < end) {
                draw(std::span<const ProjectedTriangle>(chunk.triangles),
                     std::span(chunk.numbers).subspan(begin, end - begin));
            }
        }
    }

  private:
    struct Entry {
        std::uint32_t tile;
        std::uint32_t number;
    };
    // Neighbouring triangles of the mesh.
    struct Chunk {
        std::vector<ProjectedTriangle> triangles;  // those that may show
        std::vector<Entry> entries;
        std::vector<std::uint32_t> begins;   // [tiles + 1], in `numbers`
        std::vector<std::uint32_t> numbers;  // of `triangles`, tile by tile
    };

    void fill_chunk(std::span<const transport::SurfaceTriangle> triangles,
                    std::uint32_t first,
                    std::span<const std::uint8_t> is_in,
                    Chunk& chunk);
    void add_entries(const ProjectedTriangle& triangle, std::uint32_t number, Chunk& chunk);
    void sort_entries(Chunk& chunk) const;

    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t tiles_x_ = 0;
    std::uint32_t tiles_y_ = 0;
    std::vector<Imath::V3d> corners_;  // of every vertex, in pixel space
    std::vector<Chunk> chunks_;
};

}  // namespace relume::view
