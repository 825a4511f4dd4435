// How far an image under the light as filtered is from one under the map itself.
#pragma once

#include "precompute/scene/scene.h"
#include "server/light/prefiltered_environment.h"

#include <cstdint>

namespace relume::lab {

struct LightFilterOptions {
    std::uint32_t image_side = 32;
    std::uint32_t samples = 256;  // paths a pixel, for each of two independent images
    std::uint32_t bounces = 1;
    std::uint32_t turns = 3;  // random rotations
    std::uint64_t seed = 1;
};

// Relative L2 distances, over the pixels that see the scene, to an image of the same paths
// under the map at full resolution, turned.
struct LightFilterError {
    struct Distance {
        double value = 0;
        double least = 0;  // so much the paths' noise alone may look like, one deviation
    };
    Distance filtered;     // under what server/light makes of it (protocol/light.md)
    Distance texel_means;  // under the mean radiance of each texel: what n alone costs
};

// Path-traced in double precision by tests/support/reference_tracer. The paths' own noise is
// kept out: the squared distance is the product of two independent images' differences, whose
// expectation it is.
[[nodiscard]] LightFilterError light_filter_error(
    const scene::Scene& scene,
    const light::PrefilteredEnvironment& environment,
    const LightFilterOptions& options);

}  // namespace relume::lab
