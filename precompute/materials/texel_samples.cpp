#include "precompute/materials/texel_samples.h"

#include "protocol/basis/cubemap.h"

namespace relume::materials {

TexelSamples::TexelSamples(std::uint32_t face_resolution, std::uint32_t samples_per_side)
    : face_resolution_(face_resolution),
      samples_per_texel_(std::size_t{samples_per_side} * samples_per_side) {
    const std::uint32_t n = face_resolution;
    const std::uint32_t fine = n * samples_per_side;
    for (std::size_t texel = 0; texel < basis::texel_count(n); ++texel) {
        const basis::Texel place = basis::texel_from_index(n, texel);
        for (std::uint32_t sample = 0; sample < samples_per_texel_; ++sample) {
            // A part of a texel is a texel of a finer cubemap.
            const basis::Texel part{
                .face = place.face,
                .row = place.row * samples_per_side + sample / samples_per_side,
                .column = place.column * samples_per_side + sample % samples_per_side};
            const auto direction = basis::direction_from_texel(fine, part);
            x_.push_back(direction.x);
            y_.push_back(direction.y);
            z_.push_back(direction.z);
            solid_angles_sr_.push_back(
                static_cast<float>(basis::solid_angle_sr(fine, part.row, part.column)));
        }
    }
}

}  // namespace relume::materials
