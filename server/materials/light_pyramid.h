// The light of a cubemap at every resolution, for directions that stand for wide cones.
#pragma once

#include "protocol/light/light_cubemap.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::materials {

// Immutable and thread-safe.
class LightPyramid {
  public:
    explicit LightPyramid(const light::LightCubemap& cubemap);

    // Mean radiance of the texel around a direction, of the resolution whose texels are about
    // as large as `solid_angle_sr` or, where that is less than the finest, of the finest.
    [[nodiscard]] Imath::V3f radiance(const Imath::V3f& direction, float solid_angle_sr) const;

  private:
    struct Level {
        std::uint32_t face_resolution;
        std::vector<Imath::V3f> radiance;  // by texel
    };
    std::vector<Level> levels_;  // the finest first
};

}  // namespace relume::materials
