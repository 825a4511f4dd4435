#include "precompute/bake/light_model.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/transport/hash.h"

#include <cmath>
#include <numbers>

namespace relume::bake {

std::vector<float> natural_light(std::uint32_t n, std::uint64_t seed) {
    const std::size_t count = basis::texel_count(n);
    const auto side = static_cast<float>(n);
    // Band b has 18·4^b wavelets of amplitude a·2^(−falloff·b); the constant has energy 6·n².
    float energy = 0;
    for (std::uint32_t band = 0; band < basis::band_count(n); ++band) {
        energy += 18 * std::exp2((2 - 2 * kNaturalFalloff) * static_cast<float>(band));
    }
    const float amplitude = side * std::sqrt(6 / energy);
    std::vector<float> light(count);
    for (std::size_t j = 0; j < count; ++j) {
        if (j % (std::size_t{n} * n) == 0) {
            light[j] = side;
            continue;
        }
        const std::uint64_t bits = transport::mix_bits(transport::mix_bits(seed) + j);
        // Box and Muller's normal variate.
        const float radius = std::sqrt(-2.0F * std::log(1.0F - transport::unit_float(bits)));
        const float angle = 2 * std::numbers::pi_v<float> * transport::unit_float(bits << 32U);
        const auto band = static_cast<float>(basis::band_from_coefficient(n, j));
        light[j] = amplitude * radius * std::cos(angle) * std::exp2(-kNaturalFalloff * band);
    }
    return light;
}

std::vector<float> sun_light(std::uint32_t n, std::uint64_t seed) {
    std::vector<float> light(basis::texel_count(n));
    for (std::uint64_t attempt = 0;; ++attempt) {
        const std::size_t texel =
            transport::mix_bits(transport::mix_bits(seed) + attempt) % light.size();
        if (basis::direction_from_texel(n, basis::texel_from_index(n, texel)).y > 0.2F) {
            light[texel] = static_cast<float>(light.size());
            break;
        }
    }
    basis::haar_forward_cubemap(n, light);
    return light;
}

}  // namespace relume::bake
