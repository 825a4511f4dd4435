#include "server/view/mesh/mesh_view.h"

#include "server/view/mesh/pinhole_from_look.h"
#include "server/view/mesh/seen_vertices.h"
#include "server/view/mesh/tile_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace relume::view {
namespace {

transport::CameraRecord record_from(const Pinhole& pinhole) {
    return {.eye = Imath::V3f(pinhole.eye),
            .right = Imath::V3f(pinhole.right),
            .up = Imath::V3f(pinhole.up),
            .forward = Imath::V3f(pinhole.forward),
            .tan_half_width = static_cast<float>(pinhole.tan_half_width),
            .tan_half_height = static_cast<float>(pinhole.tan_half_height)};
}

// What a pixel's terms take, where it shows one point.
std::size_t bytes_of_pixel(const DrawnSurface& surface) {
    return sizeof(TilePixel) + sizeof(TilePoint) +
           VertexRadiance::kFloatsPerTerm * sizeof(float) * surface.most_terms();
}

}  // namespace

MeshView::MeshView(std::shared_ptr<const DrawnSurface> surface,
                   VertexRadiance radiance,
                   const transport::FrameRecord& frame,
                   const Look& beginning,
                   const GivenRadiance* given)
    : surface_(std::move(surface)),
      frame_(frame),
      radiance_(std::move(radiance)),
      given_(given) {
    look(beginning);
}

bool MeshView::look(const Look& look) {
    if (look == look_ && image_.width != 0) {
        return false;
    }
    look_ = look;
    pinhole_ = pinhole_from_look(look, frame_);
    image_ = {.width = look.width, .height = look.height};
    camera_ = record_from(pinhole_);
    visible_.look(surface_->mesh(), pinhole_, look.width, look.height, &surface_->holes());
    is_closer_ = false;
    forget_terms();
    return true;
}

bool MeshView::look_closer() {
    if (is_closer_) {
        return false;
    }
    visible_.look_at_edges(surface_->mesh());
    is_closer_ = true;
    forget_terms();
    return true;
}

void MeshView::forget_terms() {
    images_ = 0;
    kept_.clear();
}

SeenVertices MeshView::seen_vertices() const {
    return given_ == nullptr ? SeenVertices{}
                             : view::seen_vertices(*surface_, visible_, *given_);
}

void MeshView::write_coverage(std::span<float> coverage) const {
    tbb::parallel_for(std::uint32_t{0}, image_.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < image_.width; ++x) {
            const std::span<const SurfacePoint> points = visible_.points(x, y);
            const auto hits = std::count_if(
                points.begin(), points.end(),
                [](const SurfacePoint& point) { return point.triangle != kNoTriangle; });
            coverage[std::size_t{y} * image_.width + x] =
                static_cast<float>(hits) / static_cast<float>(points.size());
        }
    });
}

void MeshView::begin_image(std::span<const float> sums) {
    if (radiance_is_stale_) {
        radiance_.take(sums);
        radiance_is_stale_ = false;
    }
    if (given_ != nullptr) {
        take_given_radiance();
    }
    if (++images_ == 2) {
        keep_terms();
    }
}

void MeshView::take_given_radiance() {
    if (given_->materials_version() != given_materials_) {
        given_materials_ = given_->materials_version();
        forget_terms();
    }
    if (given_->radiance_version() != given_radiance_) {
        given_radiance_ = given_->radiance_version();
        radiance_.take_given(*given_);
    }
}

void MeshView::keep_terms() {
    const std::size_t pixels = std::size_t{image_.width} * image_.height +
                               visible_.edge_count() * VisibleSurface::kSamplesOfEdge;
    if (pixels * bytes_of_pixel(*surface_) > kMostKeptBytes) {
        return;
    }
    kept_.resize(image_.block_count());
    tbb::parallel_for(std::uint32_t{0}, image_.block_count(), [&](std::uint32_t tile) {
        make_tile_terms(*surface_, visible_, pinhole_, pixels_of_tile(tile), given_,
                        kept_[tile]);
    });
}

PixelRect MeshView::pixels_of_tile(std::uint32_t tile) const {
    const std::uint32_t x = tile % image_.tiles_x();
    return pixels_of(image_, {.row = tile / image_.tiles_x(), .first = x, .last = x + 1});
}

void MeshView::write_tiles(std::span<const float> /*sums*/,
                           const TileRun& tiles,
                           std::span<float> rgb) const {
    const PixelRect all = pixels_of(image_, tiles);
    require_size(rgb, all);
    thread_local TileTerms made;
    for (std::uint32_t x = tiles.first; x < tiles.last; ++x) {
        const std::uint32_t tile = tiles.row * image_.tiles_x() + x;
        const PixelRect pixels = pixels_of_tile(tile);
        if (kept_.empty()) {
            make_tile_terms(*surface_, visible_, pinhole_, pixels, given_, made);
        }
        write_tile_pixels(kept_.empty() ? made : kept_[tile], radiance_.values(), pixels.width,
                          std::size_t{3} * all.width,
                          &rgb[std::size_t{3} * (pixels.left - all.left)]);
    }
}

}  // namespace relume::view
