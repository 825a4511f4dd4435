// From texels of the lighting cubemap to coefficients of a basis, and back.
//
// With Ω the solid angle of a texel and M(j, texel) the mean of basis function j over it, the
// coefficients of light are Σ Ω·M·(mean radiance of the texel), those of transport
// Σ M·(response to radiance 1 in the texel). Σ_j T_j L_j is then the response to the light as
// far as the basis holds it, and to a constant light exactly. For Haar both projections are the
// transform of haar.h, whose functions are orthonormal over texels and not over the sphere.
#pragma once

#include "protocol/basis/cubemap_basis.h"

#include <memory>
#include <span>

namespace relume::basis {

// Immutable; safe to share between threads. Texels are 6·n² values in the order of cubemap.h,
// coefficients as many as the basis has; input and output do not overlap.
class CubemapProjection {
  public:
    [[nodiscard]] static std::shared_ptr<const CubemapProjection> onto(
        const CubemapBasis& basis);

    virtual ~CubemapProjection() = default;
    CubemapProjection(const CubemapProjection&) = delete;
    CubemapProjection& operator=(const CubemapProjection&) = delete;

    [[nodiscard]] const CubemapBasis& basis() const { return basis_; }

    // Mean radiance of every texel to lighting coefficients.
    virtual void project_radiance(std::span<const float> texels,
                                  std::span<float> coefficients) const = 0;
    // Response to radiance 1 in every texel to a row of transport.
    virtual void project_response(std::span<const float> texels,
                                  std::span<float> coefficients) const = 0;
    // The light that lighting coefficients stand for, as the mean radiance of every texel.
    virtual void reconstruct_radiance(std::span<const float> coefficients,
                                      std::span<float> texels) const = 0;

  protected:
    explicit CubemapProjection(const CubemapBasis& basis) : basis_(basis) {}

  private:
    CubemapBasis basis_;
};

}  // namespace relume::basis
