// Lights of a formula, and how far two relit images are apart.
#pragma once

#include "precompute/bake/relight.h"
#include "protocol/basis/cubemap.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace relume::bake {

// `radiance(direction)` in red, green and blue alike, at the directions of the texels' centres.
template <typename Radiance>
CubemapLight light_from(std::uint32_t face_resolution, Radiance radiance) {
    CubemapLight light;
    for (std::size_t i = 0; i < basis::texel_count(face_resolution); ++i) {
        const float value = radiance(basis::direction_from_texel(
            face_resolution, basis::texel_from_index(face_resolution, i)));
        for (auto& plane : light) {
            plane.push_back(value);
        }
    }
    return light;
}

// ‖image − reference‖ / ‖reference‖ over all pixels and colours.
inline double relative_l2(const DenseImage& image, const DenseImage& reference) {
    double difference = 0;
    double norm = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t p = 0; p < reference.rgb[c].size(); ++p) {
            difference += std::pow(image.rgb[c][p] - reference.rgb[c][p], 2);
            norm += std::pow(reference.rgb[c][p], 2);
        }
    }
    return std::sqrt(difference / norm);
}

}  // namespace relume::bake
