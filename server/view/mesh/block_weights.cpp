#include "server/view/mesh/block_weights.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace relume::view {
namespace {

using Counts = std::vector<std::uint64_t>;  // of every cluster

// Places of some rows that have corners in each cluster. Neighbouring ones mostly show the same
// triangle, and are added together.
void add_rows(const DrawnSurface& surface,
              const VisibleSurface& visible,
              const tbb::blocked_range<std::uint32_t>& rows,
              Counts& counts) {
    std::uint32_t triangle = kNoTriangle;
    std::uint64_t places = 0;
    const auto add = [&] {
        if (triangle == kNoTriangle) {
            return;
        }
        for (const std::uint32_t vertex : surface.mesh().triangles[triangle].vertices) {
            counts[surface.cluster(vertex)] += places;
        }
    };
    for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) {
        for (std::uint32_t x = 0; x < visible.width(); ++x) {
            const std::span<const SurfacePoint> points = visible.points(x, y);
            const std::uint64_t each = VisibleSurface::kSamplesOfEdge / points.size();
            for (const SurfacePoint& point : points) {
                if (point.triangle != triangle) {
                    add();
                    triangle = point.triangle;
                    places = 0;
                }
                places += each;
            }
        }
    }
    add();
}

}  // namespace

std::vector<float> block_weights(const DrawnSurface& surface, const VisibleSurface& visible) {
    const std::span<const transport::Cluster> clusters = surface.clusters().clusters();
    const Counts counts = tbb::parallel_reduce(
        tbb::blocked_range<std::uint32_t>(0, visible.height(), 16), Counts(clusters.size(), 0),
        [&](const tbb::blocked_range<std::uint32_t>& rows, Counts sum) {
            add_rows(surface, visible, rows, sum);
            return sum;
        },
        [](Counts a, const Counts& b) {
            std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
            return a;
        });
    std::vector<float> weights;
    weights.reserve(surface.clusters().block_count());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const float weight = static_cast<float>(counts[i]) /
                             static_cast<float>(VisibleSurface::kSamplesOfEdge) /
                             static_cast<float>(clusters[i].vertices);
        weights.insert(weights.end(), clusters[i].terms, weight);
    }
    if (std::all_of(weights.begin(), weights.end(), [](float weight) { return weight == 0; })) {
        weights.assign(weights.size(), 1);
    }
    return weights;
}

}  // namespace relume::view
