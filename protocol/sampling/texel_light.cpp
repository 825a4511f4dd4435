#include "protocol/sampling/texel_light.h"

#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace relume::sampling {

TexelLight::TexelLight(light::LightCubemap cubemap) : cubemap_(std::move(cubemap)) {
    const std::uint32_t n = cubemap_.face_resolution;
    const auto planes = std::as_const(cubemap_).planes();
    double total = 0;
    for (std::size_t texel = 0; texel < cubemap_.plane_size(); ++texel) {
        const basis::Texel at = basis::texel_from_index(n, texel);
        const double radiance =
            (double{planes[0][texel]} + double{planes[1][texel]} + double{planes[2][texel]}) /
            3;
        total += radiance * basis::solid_angle_sr(n, at.row, at.column);
        cumulative_.push_back(total);
    }
    probability_.resize(cumulative_.size());
    double before = 0;
    for (std::size_t texel = 0; total > 0 && texel < cumulative_.size(); ++texel) {
        cumulative_[texel] /= total;
        probability_[texel] = static_cast<float>(cumulative_[texel] - before);
        before = cumulative_[texel];
    }
}

Imath::V3f TexelLight::radiance(const Imath::V3f& direction) const {
    const std::uint32_t n = cubemap_.face_resolution;
    const std::size_t texel =
        basis::index_from_texel(n, basis::texel_from_direction(n, direction));
    const auto planes = cubemap_.planes();
    return {planes[0][texel], planes[1][texel], planes[2][texel]};
}

TexelLight::Sample TexelLight::sample(float u_texel, const Imath::V2f& u) const {
    if (!(cumulative_.back() > 0)) {
        return {};
    }
    const auto found =
        std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, double{u_texel});
    const auto texel = static_cast<std::size_t>(found - cumulative_.begin());
    const std::uint32_t n = cubemap_.face_resolution;
    Sample sample;
    sample.direction =
        basis::direction_from_texel(n, basis::texel_from_index(n, texel), u.x, u.y);
    sample.pdf = pdf_in_texel(texel, sample.direction);
    return sample;
}

float TexelLight::pdf(const Imath::V3f& direction) const {
    const std::uint32_t n = cubemap_.face_resolution;
    return pdf_in_texel(basis::index_from_texel(n, basis::texel_from_direction(n, direction)),
                        direction);
}

// A face is 2×2, and a solid angle is its part of the face over the cubed distance of the place
// from the cube's middle.
float TexelLight::pdf_in_texel(std::size_t texel, const Imath::V3f& direction) const {
    const auto n = static_cast<float>(cubemap_.face_resolution);
    const float inverse_distance =
        std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    return probability_[texel] * n * n /
           (4 * inverse_distance * inverse_distance * inverse_distance);
}

}  // namespace relume::sampling
