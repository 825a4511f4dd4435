// Radiance that arrives along a ray in the scene as it is: the light where the ray leaves the
// scene, else what the surface that it meets reflects of the light, with the materials of the
// scene's file.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "protocol/sampling/texel_light.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::bake {

// Where the random numbers of a path lie in the sequences (rays/sobol.h).
struct PathNumbers {
    std::uint32_t index = 0;
    std::uint64_t key = 0;
};

// Thread-safe.
class FrozenRadiance {
  public:
    // `bounces`: scattering events after the ray's start; 0: what it meets is black. Keeps
    // references to both.
    FrozenRadiance(const RayCaster& caster,
                   const sampling::TexelLight& light,
                   std::uint32_t bounces)
        : caster_(caster), light_(light), bounces_(bounces) {}

    [[nodiscard]] const sampling::TexelLight& light() const { return light_; }

    // An unbiased estimate. At every surface the path looks for the light twice, where it is
    // bright and where the surface reflects to, by multiple importance sampling with the
    // balance heuristic [Veach97]; it goes on in the second direction. Adds to `rays` those
    // cast.
    [[nodiscard]] Imath::V3f incoming(const Imath::V3f& origin,
                                      const Imath::V3f& direction,
                                      const PathNumbers& numbers,
                                      std::uint64_t& rays) const;

  private:
    const RayCaster& caster_;
    const sampling::TexelLight& light_;
    std::uint32_t bounces_;
};

}  // namespace relume::bake
