#include "protocol/basis/cubemap_basis.h"

#include "protocol/basis/haar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace relume::basis {

CubemapBasis CubemapBasis::haar(std::uint32_t face_resolution) {
    return {Kind::haar, face_resolution, 0};
}

CubemapBasis CubemapBasis::spherical_harmonics(std::uint32_t order,
                                               std::uint32_t face_resolution) {
    if (order < 1 || order > kMaxShOrder) {
        throw std::invalid_argument("order of spherical harmonics is " + std::to_string(order) +
                                    ", expected 1 to " + std::to_string(kMaxShOrder));
    }
    return {Kind::spherical_harmonics, face_resolution, order};
}

CubemapBasis::CubemapBasis(Kind kind, std::uint32_t face_resolution, std::uint32_t order)
    : kind_(kind), face_resolution_(face_resolution), order_(order) {
    if (!is_face_resolution(face_resolution)) {
        throw std::invalid_argument("face resolution is " + std::to_string(face_resolution) +
                                    ", expected a power of two from " +
                                    std::to_string(kMinFaceResolution) + " to " +
                                    std::to_string(kMaxFaceResolution));
    }
}

std::size_t CubemapBasis::coefficient_count() const {
    return kind_ == Kind::haar ? texel_count(face_resolution_) : sh_count(order_);
}

std::uint32_t CubemapBasis::band_count() const {
    return kind_ == Kind::haar ? basis::band_count(face_resolution_) : order_;
}

std::uint32_t CubemapBasis::band_from_coefficient(std::size_t coefficient) const {
    return kind_ == Kind::haar ? basis::band_from_coefficient(face_resolution_, coefficient)
                               : sh_band_from_index(coefficient);
}

float CubemapBasis::octave_from_band(std::uint32_t band) const {
    const auto frequency = static_cast<float>(band);
    return kind_ == Kind::haar ? frequency : std::log2(std::max(frequency, 1.0F));
}

Bands CubemapBasis::bands() const {
    Bands bands;
    for (std::size_t j = 0; j < coefficient_count(); ++j) {
        bands.of_coefficient.push_back(static_cast<std::uint8_t>(band_from_coefficient(j)));
    }
    for (std::uint32_t band = 0; band < band_count(); ++band) {
        bands.octaves.push_back(octave_from_band(band));
    }
    return bands;
}

std::vector<CubemapBasis::Term> CubemapBasis::constant_light() const {
    if (kind_ == Kind::spherical_harmonics) {
        return {{.coefficient = 0, .value = std::sqrt(4 * std::numbers::pi_v<float>)}};
    }
    std::vector<Term> terms;
    const std::uint32_t face_size = face_resolution_ * face_resolution_;
    for (std::uint32_t face = 0; face < kFaceCount; ++face) {
        terms.push_back(
            {.coefficient = face * face_size, .value = static_cast<float>(face_resolution_)});
    }
    return terms;
}

}  // namespace relume::basis
