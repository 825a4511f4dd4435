#include "precompute/bake/blocks/light_model.h"

#include "protocol/transport/hash.h"

#include <cmath>
#include <numbers>

namespace relume::bake {

namespace {

float natural_falloff(const basis::CubemapBasis& basis, std::size_t coefficient) {
    const std::uint32_t band = basis.band_from_coefficient(coefficient);
    return std::exp2(-kNaturalFalloff * basis.octave_from_band(band));
}

// That of the noise in band 0. `constant` are the coefficients that have none.
float natural_amplitude(const basis::CubemapBasis& basis, const std::vector<float>& constant) {
    float constant_energy = 0;
    std::vector<float> noise_in_band(basis.band_count());
    for (std::size_t j = 0; j < constant.size(); ++j) {
        constant_energy += constant[j] * constant[j];
        noise_in_band[basis.band_from_coefficient(j)] += constant[j] == 0 ? 1.0F : 0.0F;
    }
    float energy = 0;
    for (std::uint32_t band = 0; band < basis.band_count(); ++band) {
        const float falloff = std::exp2(-kNaturalFalloff * basis.octave_from_band(band));
        energy += noise_in_band[band] * (falloff * falloff);
    }
    return energy > 0 ? std::sqrt(constant_energy / energy) : 0.0F;
}

std::vector<float> constant_coefficients(const basis::CubemapBasis& basis) {
    std::vector<float> constant(basis.coefficient_count());
    for (const auto& [index, value] : basis.constant_light()) {
        constant[index] = value;
    }
    return constant;
}

}  // namespace

std::vector<float> natural_deviations(const basis::CubemapBasis& basis) {
    const std::vector<float> constant = constant_coefficients(basis);
    const float amplitude = natural_amplitude(basis, constant);
    std::vector<float> deviations(constant.size());
    for (std::size_t j = 0; j < deviations.size(); ++j) {
        deviations[j] = constant[j] != 0 ? 0.0F : amplitude * natural_falloff(basis, j);
    }
    return deviations;
}

std::vector<float> natural_light(const basis::CubemapBasis& basis, std::uint64_t seed) {
    std::vector<float> light = constant_coefficients(basis);
    const float amplitude = natural_amplitude(basis, light);
    for (std::size_t j = 0; j < light.size(); ++j) {
        if (light[j] != 0) {
            continue;
        }
        const std::uint64_t bits = transport::mix_bits(transport::mix_bits(seed) + j);
        // Box and Muller's normal variate.
        const float radius = std::sqrt(-2.0F * std::log(1.0F - transport::unit_float(bits)));
        const float angle = 2 * std::numbers::pi_v<float> * transport::unit_float(bits << 32U);
        light[j] = amplitude * radius * std::cos(angle) * natural_falloff(basis, j);
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

SignalModel light_signals(const basis::CubemapProjection& projection) {
    const basis::CubemapBasis& basis = projection.basis();
    SignalModel model;
    for (std::uint64_t i = 0; i < kSignalsPerKind; ++i) {
        model.signals.push_back(natural_light(basis, i));
    }
    for (std::uint64_t i = 0; i < kSignalsPerKind; ++i) {
        model.signals.push_back(sun_light(projection, i));
    }
    for (std::size_t j = 0; j < basis.coefficient_count(); ++j) {
        model.band.push_back(basis.band_from_coefficient(j));
    }
    for (std::uint32_t band = 0; band < basis.band_count(); ++band) {
        const double octave = basis.octave_from_band(band);
        model.natural_weight.push_back(std::exp2(-2.0 * double{kNaturalFalloff} * octave));
        model.step_growth.push_back(std::exp2(kStepGrowth * basis.octave_from_band(band)));
    }
    return model;
}

}  // namespace relume::bake
