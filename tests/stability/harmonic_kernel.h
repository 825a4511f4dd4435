// What light of one direction becomes in spherical harmonics.
#pragma once

#include <cstdint>

namespace relume::stability {

// K(γ) = Σ_{l<k} (2l+1)/4π · P_l(cos γ): light of energy 1 from one direction, cut off at order
// k and seen at the angle γ from it. Whatever is lit, its light in order k is a mean of K over
// texels and directions, weighted by the energy that came from there; so no bound that follows
// from K depends on the light, as long as that is nowhere negative.
class HarmonicKernel {
  public:
    explicit HarmonicKernel(std::uint32_t order);

    [[nodiscard]] double at(double cosine) const;
    [[nodiscard]] double highest() const { return at(1); }  // k²/4π
    [[nodiscard]] double lowest() const { return lowest_; }
    // ∫|K| dω, the Lebesgue constant: by so much the L1 norm of a light can grow. Grows as √k.
    [[nodiscard]] double l1() const { return l1_; }

  private:
    std::uint32_t order_;
    double lowest_ = 0;
    double l1_ = 0;
};

}  // namespace relume::stability
