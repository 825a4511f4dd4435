// Lighting coefficients drawn from a seed.
#pragma once

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/transport/format.h"

#include <cstdint>
#include <random>
#include <vector>

namespace relume::test {

// Planar [3][6n²] Haar coefficients of a dim, smooth sky with a few bright texels, as real
// lighting is: a heavy tail in every band.
inline std::vector<float> random_lighting(std::uint32_t n,
                                          std::uint64_t seed,
                                          float sun = 300) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    const std::size_t texels = basis::texel_count(n);
    std::vector<float> lighting(transport::kColours * texels);
    const float slope = uniform(random);
    for (std::size_t i = 0; i < lighting.size(); ++i) {
        const float height = static_cast<float>(i % texels) / static_cast<float>(texels);
        lighting[i] = 0.2F + slope * height + 0.1F * uniform(random);
    }
    for (int i = 0; i < 3; ++i) {
        const auto texel =
            static_cast<std::size_t>(uniform(random) * static_cast<float>(texels - 1));
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            lighting[c * texels + texel] += sun * uniform(random);
        }
    }
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        basis::haar_forward_cubemap(n, std::span(lighting).subspan(c * texels, texels));
    }
    return lighting;
}

}  // namespace relume::test
