#include "precompute/bake/blocks/light_model.h"

#include "protocol/transport/hash.h"

#include <cmath>
#include <numbers>

namespace relume::bake {

std::vector<float> natural_light(const basis::CubemapBasis& basis, std::uint64_t seed) {
    const std::size_t count = basis.coefficient_count();
    std::vector<float> light(count);
    float constant_energy = 0;
    for (const auto& [index, value] : basis.constant_light()) {
        light[index] = value;
        constant_energy += value * value;
    }
    std::vector<float> noise_in_band(basis.band_count());
    for (std::size_t j = 0; j < count; ++j) {
        noise_in_band[basis.band_from_coefficient(j)] += light[j] == 0 ? 1.0F : 0.0F;
    }
    const auto falloff = [&](std::uint32_t band) {
        return std::exp2(-kNaturalFalloff * basis.octave_from_band(band));
    };
    float energy = 0;
    for (std::uint32_t band = 0; band < basis.band_count(); ++band) {
        energy += noise_in_band[band] * (falloff(band) * falloff(band));
    }
    const float amplitude = energy > 0 ? std::sqrt(constant_energy / energy) : 0.0F;
    for (std::size_t j = 0; j < count; ++j) {
        if (light[j] != 0) {
            continue;
        }
        const std::uint64_t bits = transport::mix_bits(transport::mix_bits(seed) + j);
        // Box and Muller's normal variate.
        const float radius = std::sqrt(-2.0F * std::log(1.0F - transport::unit_float(bits)));
        const float angle = 2 * std::numbers::pi_v<float> * transport::unit_float(bits << 32U);
        light[j] =
            amplitude * radius * std::cos(angle) * falloff(basis.band_from_coefficient(j));
    }
    return light;
}

std::vector<float> sun_light(const basis::CubemapProjection& projection, std::uint64_t seed) {
    const std::uint32_t n = projection.basis().face_resolution();
    std::vector<float> texels(basis::texel_count(n));
    for (std::uint64_t attempt = 0;; ++attempt) {
        const std::size_t texel =
            transport::mix_bits(transport::mix_bits(seed) + attempt) % texels.size();
        if (basis::direction_from_texel(n, basis::texel_from_index(n, texel)).y > 0.2F) {
            texels[texel] = static_cast<float>(texels.size());
            break;
        }
    }
    std::vector<float> light(projection.basis().coefficient_count());
    projection.project_radiance(texels, light);
    return light;
}

}  // namespace relume::bake
