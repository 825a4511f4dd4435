// Functions on faces and cubemaps for the tests of tripling, by seed.
#pragma once

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace relume::tripling {

// Values from a normal distribution; each is kept with the probability `density`, 0 otherwise.
inline std::vector<float> random_values(std::size_t count, unsigned seed, double density = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::bernoulli_distribution keep(density);
    std::vector<float> values(count);
    std::generate(values.begin(), values.end(), [&] {
        const float value = normal(random);
        return keep(random) ? value : 0.0F;
    });
    return values;
}

inline std::vector<float> random_cubemap(std::uint32_t n, unsigned seed) {
    return random_values(basis::texel_count(n), seed);
}

// Open texels of a cubemap: a few discs are closed, as objects close them.
inline std::vector<float> random_visibility(std::uint32_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> cosine(0.5F, 0.95F);
    std::vector<float> open(basis::texel_count(n), 1);
    for (int disc = 0; disc < 4; ++disc) {
        const Imath::V3f centre =
            Imath::V3f(normal(random), normal(random), normal(random)).normalized();
        const float edge = cosine(random);
        for (std::size_t i = 0; i < open.size(); ++i) {
            const auto direction =
                basis::direction_from_texel(n, basis::texel_from_index(n, i));
            open[i] = direction.dot(centre) > edge ? 0 : open[i];
        }
    }
    return open;
}

// A bit a texel, set where the value is not 0.
inline std::vector<std::uint64_t> bits_of(std::span<const float> open) {
    std::vector<std::uint64_t> bits((open.size() + 63) / 64, 0);
    for (std::size_t i = 0; i < open.size(); ++i) {
        bits[i / 64] |= std::uint64_t{open[i] != 0} << i % 64;
    }
    return bits;
}

// Coefficients of the six faces of a cubemap, n a power of two from 1 on.
inline std::vector<float> coefficients_of(std::uint32_t n, std::vector<float> texels) {
    basis::haar_forward_cubemap(n, texels);
    return texels;
}

inline std::vector<double> in_double(std::span<const float> values) {
    return {values.begin(), values.end()};
}

}  // namespace relume::tripling
