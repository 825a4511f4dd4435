// Splits the edges of a surface where light is not linear between its vertices.
//
// In every triangle light is looked at in the middles of its sides and at places within, and
// compared with what its corners make of it. The integral of the squared difference, by a rule
// that is exact for cubics, is the triangle's error: it weighs as much as the area that it
// fills in images from all sides. The triangles with the largest errors are cut at their
// longest edges (split_mesh.h), round after round, until the error of the whole is small
// enough or the vertices are as many as may be.
#pragma once

#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/bake/receivers/vertex/surface_probe.h"
#include "precompute/scene/scene.h"

#include <cstddef>
#include <functional>

namespace relume::bake {

struct RefinementOptions {
    std::size_t most_vertices = 40'000;  // 3 … kMostSurfaceVertices
    double target_error = 0.01;          // as RefinementReport::interpolation_error; ≥ 0
    // Called between rounds with the vertices so far; may throw to end the refinement.
    std::function<void(std::size_t)> progress{};
};

inline constexpr std::size_t kMostSurfaceVertices = 1'000'000;

// The surface is refined until its interpolation error is at most the target, or the next split
// would make more than the vertices allowed, or no edge can be split. Memory: about
// kSurfaceBytesPerVertex for each vertex. Runs in parallel and depends on nothing but the
// scene, the probe and the options. Throws BakeError as start_surface does, and where an option
// is out of range.
[[nodiscard]] RefinedSurface refine_surface(const scene::Scene& scene,
                                            const SurfaceProbe& probe,
                                            const RefinementOptions& options);

}  // namespace relume::bake
