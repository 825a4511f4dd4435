// What a refined surface shows between its vertices, against rows of the very points that are
// seen.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/scene.h"
#include "protocol/transport/transport.h"

#include <cstddef>

namespace relume::lab {

struct InterpolationError {
    double relative_l2 = 0;  // of radiance towards the camera, over the points
    // The same where corners have rows as fine as those of the points: what interpolation alone
    // is off by.
    double of_exact_corners = 0;
    std::size_t points = 0;
};

// What the vertices' own samples leave off is in the error, what those of the points do is not.
// Looks through the middles of pixels, spread over the transport's own view. Each point gets
// rows of its own, with as many paths as `parameters` ask for, and is compared with what the
// corners of its triangle make of it under `light`: colours are the lobes' means, so that no
// texture is in it. The scene, and the parameters but for samples, are those of the bake.
// Parallel.
[[nodiscard]] InterpolationError interpolation_error(const scene::Scene& scene,
                                                     const transport::Transport& transport,
                                                     const bake::BakeParameters& parameters,
                                                     const bake::CubemapLight& light,
                                                     std::size_t points);

}  // namespace relume::lab
