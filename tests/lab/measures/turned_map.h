// A map as it stands after a turn: at full resolution, and as the means of texels.
#pragma once

#include "protocol/light/environment_map.h"

#include <Imath/ImathQuat.h>
#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::lab {

// Radiance of 6·n² texels in the order of protocol/basis.
struct TexelLight {
    std::uint32_t n = 0;
    std::vector<Imath::V3f> radiance;

    [[nodiscard]] const Imath::V3f& towards(const Imath::V3f& direction) const;
};

// The map must outlive it. Thread-safe.
class TurnedMap {
  public:
    // Looks the map up at 1024² points of each face, in parallel.
    TurnedMap(const light::EnvironmentMap& map, const Imath::Quatf& rotation);

    [[nodiscard]] const Imath::Quatf& rotation() const { return rotation_; }
    [[nodiscard]] Imath::V3f towards(const Imath::V3f& world_direction) const;
    // Mean radiance over each texel; n a power of two up to kMeansResolution.
    [[nodiscard]] TexelLight texel_means(std::uint32_t n) const;

    static constexpr std::uint32_t kMeansResolution = 128;

  private:
    const light::EnvironmentMap& map_;
    Imath::Quatf rotation_;
    Imath::Quatf source_from_world_;
    TexelLight means_;
};

}  // namespace relume::lab
