// What one surface of a receiver shows of every sample of a curve of its BRDF, and of its
// diffuse colour, under a light that stays as it is.
#pragma once

#include "precompute/bake/curves/edited_material.h"
#include "precompute/bake/curves/frozen_radiance.h"
#include "precompute/bake/receivers/receiver.h"
#include "protocol/sampling/curve_sampler.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::bake {

using sampling::CurveShares;

// Estimates ∫ L ρ_q hat_k cos dω for all k, ρ_q being the BRDF without the edited curve, and ∫
// L f_diffuse cos dω, from the same rays (sampling/curve_sampler.h). L is the light where a ray
// leaves the scene, else FrozenRadiance.
//
// Thread-safe. Depends on nothing but its arguments.
class CurveEstimator {
  public:
    // `samples`: of a receiver, as of a bake of light; twelve times as many are drawn by the
    // angle, so that with 64 every sample of a curve has three, six times by the light, and
    // three times by the cosine. Keeps a reference to `radiance`.
    CurveEstimator(const FrozenRadiance& radiance, std::uint32_t samples, std::uint64_t seed)
        : radiance_(radiance), samples_(samples), seed_(seed) {}

    // Of the surface as if it filled the receiver, by its share of the samples. Adds to `rays`
    // those cast.
    void estimate(const ReceiverSurface& surface,
                  const SequencePlace& place,
                  const EditedMaterial& material,
                  CurveShares& shares,
                  std::uint64_t& rays) const;

  private:
    const FrozenRadiance& radiance_;
    std::uint32_t samples_;
    std::uint64_t seed_;
};

}  // namespace relume::bake
