#include "server/view/mesh/triangle_bins.h"

#include "server/view/mesh/raster_tile.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace relume::view {
namespace {

constexpr std::size_t kVerticesPerTask = 4096;
constexpr std::size_t kTrianglesPerChunk = 8192;

// Whether the triangle may be hit in a square of the image: none of its edges has all of the
// square outside. The square is a little larger than where samples lie.
bool may_show(const ProjectedTriangle& triangle, double left, double top) {
    for (const EdgeFunction& edge : triangle.edges) {
        const double x = edge.x > 0 ? left + kRasterSide : left;
        const double y = edge.y > 0 ? top + kRasterSide : top;
        if (edge.at(x, y) < 0) {
            return false;
        }
    }
    return true;
}

}  // namespace

void TriangleBins::fill(const transport::SurfaceMesh& mesh,
                        const PixelSpace& space,
                        std::uint32_t width,
                        std::uint32_t height,
                        std::span<const std::uint8_t> is_in) {
    width_ = width;
    height_ = height;
    tiles_x_ = (width + kRasterSide - 1) / kRasterSide;
    tiles_y_ = (height + kRasterSide - 1) / kRasterSide;
    corners_.resize(mesh.vertex_count());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners_.size(), kVerticesPerTask),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t vertex = range.begin(); vertex < range.end();
                               ++vertex) {
                              corners_[vertex] = space.from_position(mesh.positions[vertex]);
                          }
                      });
    const std::span<const transport::SurfaceTriangle> triangles(mesh.triangles);
    chunks_.resize((triangles.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk);
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t i) {
        const std::size_t first = i * kTrianglesPerChunk;
        fill_chunk(
            triangles.subspan(first, std::min(kTrianglesPerChunk, triangles.size() - first)),
            static_cast<std::uint32_t>(first), is_in, chunks_[i]);
    });
}

void TriangleBins::clear() {
    tiles_x_ = tiles_y_ = 0;
    chunks_.clear();
}

bool TriangleBins::has_any(std::uint32_t tile) const {
    return std::any_of(chunks_.begin(), chunks_.end(), [tile](const Chunk& chunk) {
        return chunk.begins[tile] < chunk.begins[tile + 1];
    });
}

void TriangleBins::fill_chunk(std::span<const transport::SurfaceTriangle> triangles,
                              std::uint32_t first,
                              std::span<const std::uint8_t> is_in,
                              Chunk& chunk) {
    chunk.triangles.clear();
    chunk.entries.clear();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (!is_in.empty() && is_in[triangles[i].material] == 0) {
            continue;
        }
        const auto& vertices = triangles[i].vertices;
        auto projected =
            project({corners_[vertices[0]], corners_[vertices[1]], corners_[vertices[2]]},
                    width_, height_);
        if (!projected) {
            continue;
        }
        projected->triangle = first + static_cast<std::uint32_t>(i);
        const std::size_t entries = chunk.entries.size();
        add_entries(*projected, static_cast<std::uint32_t>(chunk.triangles.size()), chunk);
        if (chunk.entries.size() > entries) {
            chunk.triangles.push_back(*projected);
        }
    }
    sort_entries(chunk);
}

void TriangleBins::add_entries(const ProjectedTriangle& triangle,
                               std::uint32_t number,
                               Chunk& chunk) {
    if (!(triangle.left <= triangle.right && triangle.top <= triangle.bottom)) {
        return;
    }
    const auto tile_of = [](double pixel, std::uint32_t tiles) {
        return std::min(static_cast<std::uint32_t>(pixel) / kRasterSide, tiles - 1);
    };
    const std::uint32_t first_x = tile_of(triangle.left, tiles_x_);
    const std::uint32_t last_x = tile_of(triangle.right, tiles_x_);
    const std::uint32_t first_y = tile_of(triangle.top, tiles_y_);
    const std::uint32_t last_y = tile_of(triangle.bottom, tiles_y_);
    const bool is_large = last_x > first_x + 1 || last_y > first_y + 1;
    for (std::uint32_t y = first_y; y <= last_y; ++y) {
        for (std::uint32_t x = first_x; x <= last_x; ++x) {
            if (!is_large || may_show(triangle, x * kRasterSide, y * kRasterSide)) {
                chunk.entries.push_back({.tile = y * tiles_x_ + x, .number = number});
            }
        }
    }
}

// By tile, and those of a tile in the order in which they came.
void TriangleBins::sort_entries(Chunk& chunk) const {
    chunk.begins.assign(std::size_t{tiles_x_} * tiles_y_ + 1, 0);
    for (const Entry& entry : chunk.entries) {
        ++chunk.begins[entry.tile];
    }
    std::exclusive_scan(chunk.begins.begin(), chunk.begins.end(), chunk.begins.begin(), 0U);
    chunk.numbers.resize(chunk.entries.size());
    for (const Entry& entry : chunk.entries) {
        chunk.numbers[chunk.begins[entry.tile]++] = entry.number;
    }
    // Each begin has moved to the next one's place.
    std::shift_right(chunk.begins.begin(), chunk.begins.end(), 1);
    chunk.begins.front() = 0;
}

}  // namespace relume::view
