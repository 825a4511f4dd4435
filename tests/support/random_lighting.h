// Lighting coefficients drawn from a seed.
#pragma once

#include "protocol/basis/cubemap_projection.h"
#include "protocol/transport/format.h"

#include <cstdint>
#include <random>
#include <vector>

namespace relume::test {

// Planar [3][N] coefficients of a dim, smooth sky with a few bright texels, as real lighting
// is: a heavy tail in every band.
inline std::vector<float> random_lighting(const basis::CubemapBasis& basis,
                                          std::uint64_t seed,
                                          float sun = 300) {
    const std::uint32_t n = basis.face_resolution();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    const std::size_t texels = basis::texel_count(n);
    std::vector<float> radiance(transport::kColours * texels);
    const float slope = uniform(random);
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const float height = static_cast<float>(i % texels) / static_cast<float>(texels);
        radiance[i] = 0.2F + slope * height + 0.1F * uniform(random);
    }
    for (int i = 0; i < 3; ++i) {
        const auto texel =
            static_cast<std::size_t>(uniform(random) * static_cast<float>(texels - 1));
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            radiance[c * texels + texel] += sun * uniform(random);
        }
    }
    const auto projection = basis::CubemapProjection::onto(basis);
    const std::size_t count = basis.coefficient_count();
    std::vector<float> lighting(transport::kColours * count);
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        projection->project_radiance(std::span(radiance).subspan(c * texels, texels),
                                     std::span(lighting).subspan(c * count, count));
    }
    return lighting;
}

// The same in the Haar basis of a cubemap of resolution n.
inline std::vector<float> random_lighting(std::uint32_t n,
                                          std::uint64_t seed,
                                          float sun = 300) {
    return random_lighting(basis::CubemapBasis::haar(n), seed, sun);
}

}  // namespace relume::test
