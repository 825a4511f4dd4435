// The image of a scene whose materials have BRDFs of any curves, by sampling those BRDFs.
#pragma once

#include "precompute/scene/scene.h"
#include "protocol/curve/curve_brdf.h"
#include "tests/support/reference_tracer/sky.h"
#include "tests/support/reference_tracer/tracer.h"

#include <cstdint>
#include <map>

namespace relume::test {

struct CurveReference {
    std::uint32_t side = 24;      // of the square image, in pixels
    std::uint32_t samples = 256;  // directions at every pixel
    std::uint32_t bounces = 0;    // scattering events after the one that the pixel sees
    std::uint64_t seed = 3;
};

// What the middle of every pixel reflects: where it shows a material of `edited`, by the
// scene's diffuse part and this BRDF in place of the specular one, else by the scene's. Light
// that comes by way of other surfaces meets all materials as the scene has them. Directions are
// drawn from the sky and from the scene's reflection, half of them each; nothing of the bake's
// estimator takes part.
[[nodiscard]] reference::TracedImage reflect_with_curves(
    const scene::Scene& scene,
    const reference::Sky& sky,
    const std::map<std::uint32_t, curve::CurveBrdf>& edited,
    const CurveReference& options);

}  // namespace relume::test
