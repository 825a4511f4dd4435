// How many places of an image have a corner here or there on a surface.
#pragma once

#include "protocol/transport/surface_mesh.h"
#include "server/view/mesh/visible_surface.h"

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace relume::view {

using CornerCounts = std::vector<std::uint64_t>;

// A pixel has VisibleSurface::kSamplesOfEdge places, and each place counts at the three corners
// of the triangle that it shows: result[slot_of(vertex)], [slots]. Spread over the caller's
// arena; does not depend on the threads.
template <typename SlotOf>
[[nodiscard]] CornerCounts corner_counts(const transport::SurfaceMesh& mesh,
                                         const VisibleSurface& visible,
                                         std::size_t slots,
                                         const SlotOf& slot_of) {
    using Rows = tbb::blocked_range<std::uint32_t>;
    // Every thread has counts of its own: vertices may be many.
    tbb::combinable<CornerCounts> of_threads([slots] { return CornerCounts(slots, 0); });
    // Neighbouring places mostly show the same triangle, and are added together.
    const auto add_rows = [&](const Rows& rows) {
        CornerCounts& counts = of_threads.local();
        std::uint32_t triangle = kNoTriangle;
        std::uint64_t places = 0;
        const auto add = [&] {
            if (triangle != kNoTriangle) {
                for (const std::uint32_t vertex : mesh.triangles[triangle].vertices) {
                    counts[slot_of(vertex)] += places;
                }
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
    };
    constexpr std::uint32_t kRowsAtOnce = 16;
    tbb::parallel_for(Rows(0, visible.height(), kRowsAtOnce), add_rows);
    CornerCounts all(slots, 0);
    of_threads.combine_each([&](const CornerCounts& counts) {
        std::transform(all.begin(), all.end(), counts.begin(), all.begin(), std::plus<>());
    });
    return all;
}

[[nodiscard]] inline float pixels_from_places(std::uint64_t places) {
    return static_cast<float>(places) / static_cast<float>(VisibleSurface::kSamplesOfEdge);
}

}  // namespace relume::view
