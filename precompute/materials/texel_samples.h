// Directions through the texels of a cubemap with their solid angles.
#pragma once

#include "protocol/brdf/directions.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::materials {

// Immutable; safe to share between threads.
class TexelSamples {
  public:
    // samples_per_side² directions a texel, in the middles of equal parts of it.
    TexelSamples(std::uint32_t face_resolution, std::uint32_t samples_per_side);

    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    [[nodiscard]] std::size_t samples_per_texel() const { return samples_per_texel_; }
    // [texels][samples_per_texel], in the order of cubemap.h.
    [[nodiscard]] brdf::Directions directions() const { return {x_, y_, z_}; }
    // Exact, of the sample's part of the texel: all add up to 4π.
    [[nodiscard]] const std::vector<float>& solid_angles_sr() const { return solid_angles_sr_; }

  private:
    std::uint32_t face_resolution_;
    std::size_t samples_per_texel_;
    std::vector<float> x_, y_, z_, solid_angles_sr_;
};

}  // namespace relume::materials
