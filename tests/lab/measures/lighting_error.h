// How far the light shown is from the light asked for.
#pragma once

#include "protocol/light/light_cubemap.h"

#include <cstdint>
#include <vector>

namespace relume::lab {

// The L1 norm over the sphere, the same for every basis; of cubemaps of one resolution. Any
// number of threads may use it.
class LightingError {
  public:
    explicit LightingError(std::uint32_t face_resolution);

    // Σ ω |L − L̃| / Σ ω |L| over texels and colours, ω the texel's solid angle. 0 where both
    // are black, 1 where only L is. Throws std::invalid_argument on another resolution.
    [[nodiscard]] double relative_l1(const light::LightCubemap& shown,
                                     const light::LightCubemap& target) const;

  private:
    std::vector<double> solid_angles_sr_;  // [6n²]
};

}  // namespace relume::lab
