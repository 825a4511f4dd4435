#include "server/view/mesh/tile_terms.h"

#include "server/view/mesh/shaded_points.h"
#include "server/view/mesh/vertex_radiance.h"

#include <algorithm>
#include <array>

namespace relume::view {
namespace {

// A point of the tile, before it has weights.
struct Place {
    SurfacePoint point;
    SamplePosition pixel;  // in the image
    std::uint32_t first_weight = 0;
};

// Kept by a thread from one tile to the next.
struct Workspace {
    std::vector<Place> places;
    std::vector<std::uint32_t> materials;  // those that occur
    ShadedPoints shaded;
};

constexpr std::array<float, VertexRadiance::kFloatsPerTerm> kAllOfIt{1, 1, 1, 0};

void add_pixel(const DrawnSurface& surface,
               const VisibleSurface& visible,
               const GivenRadiance* given,
               std::uint32_t x,
               std::uint32_t y,
               Workspace& work,
               TileTerms& terms) {
    const std::span<const SurfacePoint> points = visible.points(x, y);
    TilePixel pixel{.places = static_cast<std::uint16_t>(points.size())};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const SurfacePoint& point = points[i];
        if (point.triangle == kNoTriangle) {
            continue;
        }
        const transport::SurfaceTriangle& triangle = surface.mesh().triangles[point.triangle];
        const std::uint32_t material = triangle.material;
        const auto& [first, second, third] = triangle.vertices;
        const std::array shares{1 - point.weight_1 - point.weight_2, point.weight_1,
                                point.weight_2};
        ++pixel.points;
        if (given != nullptr && given->is_given(material)) {
            terms.points.push_back({.first_terms = {surface.given_term(first),
                                                    surface.given_term(second),
                                                    surface.given_term(third)},
                                    .shares = shares,
                                    .terms = 1});
            terms.weights.insert(terms.weights.end(), kAllOfIt.begin(), kAllOfIt.end());
            continue;
        }
        if (std::find(work.materials.begin(), work.materials.end(), material) ==
            work.materials.end()) {
            work.materials.push_back(material);
        }
        const SamplePosition within =
            points.size() == 1 ? SamplePosition{} : VisibleSurface::position_of_sample(i);
        work.places.push_back(
            {.point = point,
             .pixel = {x + within.x, y + within.y},
             .first_weight = static_cast<std::uint32_t>(terms.weights.size())});
        const std::uint32_t term_count = surface.material(material).brdf->terms;
        terms.points.push_back(
            {.first_terms = {surface.first_term(first), surface.first_term(second),
                             surface.first_term(third)},
             .shares = shares,
             .terms = term_count});
        terms.weights.resize(terms.weights.size() +
                             std::size_t{VertexRadiance::kFloatsPerTerm} * term_count);
    }
    terms.pixels.push_back(pixel);
}

}  // namespace

void make_tile_terms(const DrawnSurface& surface,
                     const VisibleSurface& visible,
                     const Pinhole& pinhole,
                     const PixelRect& pixels,
                     const GivenRadiance* given,
                     TileTerms& terms) {
    thread_local Workspace work;
    work.places.clear();
    work.materials.clear();
    terms.pixels.clear();
    terms.points.clear();
    terms.weights.clear();
    for (std::uint32_t y = pixels.top; y < pixels.top + pixels.height; ++y) {
        for (std::uint32_t x = pixels.left; x < pixels.left + pixels.width; ++x) {
            add_pixel(surface, visible, given, x, y, work, terms);
        }
    }
    const PixelRays rays(pinhole, visible.width(), visible.height());
    for (const std::uint32_t material : work.materials) {
        work.shaded.begin(surface, material, rays);
        for (const Place& place : work.places) {
            if (surface.mesh().triangles[place.point.triangle].material != material) {
                continue;
            }
            work.shaded.add(place.point, place.pixel, &terms.weights[place.first_weight]);
            if (work.shaded.is_full()) {
                work.shaded.write_weights();
            }
        }
        work.shaded.write_weights();
    }
}

}  // namespace relume::view
