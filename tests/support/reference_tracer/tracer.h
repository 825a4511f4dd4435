// Radiance per pixel by path tracing, with the variance of the answer.
#pragma once

#include "precompute/scene/scene.h"
#include "tests/support/reference_tracer/geometry.h"
#include "tests/support/reference_tracer/random.h"
#include "tests/support/reference_tracer/sky.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace relume::reference {

// Which of a pixel's rays count: all of its square, evenly, or the one through its middle.
enum class PixelFilter { box, centre };

struct TraceOptions {
    std::uint32_t width = 32;
    std::uint32_t height = 32;
    std::uint32_t samples = 256;  // paths per pixel, at least two
    std::uint32_t bounces = 0;    // scattering events after the first; 0: direct light only
    std::uint64_t seed = 1;
    PixelFilter filter = PixelFilter::box;
};

// Row-major from the top left. A pixel is the mean over its rays of the light that the scene
// reflects there; where a ray sees past the scene it counts as black, as in a picture
// premultiplied by its coverage.
struct TracedImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Imath::V3d> mean;
    std::vector<Imath::V3d> variance;  // of the mean
};

[[nodiscard]] TracedImage trace(const scene::Scene& scene,
                                const Sky& sky,
                                const TraceOptions& options);

// One sample of the radiance that a ray brings: the sky's where it leaves the scene, else what
// reaches it by one path of at most `events` scattering events.
[[nodiscard]] Imath::V3d incoming(const Geometry& geometry,
                                  const Sky& sky,
                                  std::uint32_t events,
                                  const Imath::V3d& origin,
                                  const Imath::V3d& direction,
                                  Random& random);

// What the paths of a pixel bring: radiance from `direction` adds `weight` times itself to the
// pixel. The paths and their weights are those of trace() under `guide`, whose radiance is not
// asked: one set of paths then shows any number of lights, and two images differ by what the
// lights differ alone. `arrive` is called from several threads, for one pixel from one.
void trace_arrivals(
    const scene::Scene& scene,
    const Sky& guide,
    const TraceOptions& options,
    const std::function<void(
        std::size_t pixel, const Imath::V3d& direction, const Imath::V3d& weight)>& arrive);

}  // namespace relume::reference
