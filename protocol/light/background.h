// The rig seen directly, at the full resolution of the source maps: never the lighting's
// texels.
#pragma once

#include "protocol/light/light_rig.h"

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <memory>
#include <span>
#include <vector>

namespace relume::light {

// A rig made ready for many lookups. Keeps the rig's environments alive. Any number of threads
// may read it.
class Background {
  public:
    explicit Background(const LightRig& rig);

    // Mean radiance over pixels of so many steradians around world directions (any non-zero
    // length), up to kLooksPerRun of them. Discs of area lights have an antialiased edge one
    // pixel wide and keep their energy when they are smaller than a pixel.
    void radiances(const LookDirections& world_directions,
                   std::span<const float> footprints_sr,
                   std::span<Imath::V3f> radiances) const;
    // Of one.
    [[nodiscard]] Imath::V3f radiance(const Imath::V3f& world_direction,
                                      float footprint_sr) const;

  private:
    [[nodiscard]] LookDirections rotated(const LookDirections& world_directions) const;
    void add_environment(const PrefilteredEnvironment& environment,
                         const Imath::V3f& scale,
                         const LookDirections& source_directions,
                         std::span<const float> footprints_sr,
                         std::span<Imath::V3f> radiances) const;
    [[nodiscard]] Imath::V3f lights_seen(const Imath::V3f& world_direction,
                                         float footprint_sr) const;

    std::shared_ptr<const PrefilteredEnvironment> environment_;
    std::shared_ptr<const PrefilteredEnvironment> blend_;
    Imath::V3f environment_scale_;
    Imath::V3f blend_scale_;
    Imath::M33f source_from_world_;
    std::vector<AreaLight> lights_;
};

// One lookup.
[[nodiscard]] Imath::V3f background_radiance(const LightRig& rig,
                                             const Imath::V3f& world_direction,
                                             float footprint_sr);

}  // namespace relume::light
