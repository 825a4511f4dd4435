// How far an image under a light of texels is from one under the map itself.
#pragma once

#include "precompute/scene/scene.h"
#include "protocol/light/prefiltered_environment.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::lab {

// A light of n² texels a face, of a map: made ready and turned by protocol/light, or, without
// an environment, the mean radiance of every texel, which is what n alone costs.
struct TexelLightSource {
    std::uint32_t n = 0;
    std::shared_ptr<const light::PrefilteredEnvironment> environment;
};

struct LightFilterOptions {
    std::uint32_t image_side = 24;
    std::uint32_t samples = 768;  // paths a pixel, for each of two independent images
    std::uint32_t bounces = 1;
    std::uint32_t turns = 4;  // about the vertical, evenly from a random one on
    std::uint64_t seed = 1;
};

struct Measured {
    double value = 0;
    double least = 0;  // so much the paths' noise alone may look like, one deviation
};

// By source: relative L2 distance, over the pixels that see the scene and all turns, to the
// image under the turned map at full resolution. All lights are seen by the same paths
// (tests/support/reference_tracer), which look where the lights differ. The noise of the paths
// is kept out: the squared distance is the product of two independent images' differences,
// whose expectation it is.
[[nodiscard]] std::vector<Measured> light_filter_distances(
    const scene::Scene& scene,
    const light::EnvironmentMap& map,
    std::span<const TexelLightSource> sources,
    const LightFilterOptions& options);

// A map that is turned about the vertical by tenths of a texel, over one texel.
struct LightWalk {
    Measured flicker;  // √(Σ‖Δ(B̃ − B)‖² / Σ‖ΔB‖²), B under the map; 1 is a frozen image
    double energy_range;  // ∫L dω, from least to most, relative
};
// By source; all are of one n.
[[nodiscard]] std::vector<LightWalk> light_walks(const scene::Scene& scene,
                                                 const light::EnvironmentMap& map,
                                                 std::span<const TexelLightSource> sources,
                                                 const LightFilterOptions& options);

}  // namespace relume::lab
