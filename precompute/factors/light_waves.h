// Lights by which errors of a BRDF are weighed: random, with no direction preferred, and so
// apart by azimuthal frequency like the BRDF itself.
//
// - Uncorrelated: every direction has a light of its own, of variance 1/cos θ. The mean square
//   of what is reflected is then the square of ρ in the L2 norm under cos θi dωi × cos θo dωo.
// - Natural: a constant and noise of equal standard deviation over the sphere, whose amplitudes
//   fall as one over the frequency, as in photographs [Dror04], up to degree 64 of spherical
//   harmonics: lights of the resolution at which they relight. What such a light does not ask
//   for costs no error.
#pragma once

#include "precompute/factors/polar_grid.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace relume::factors {

enum class LightModel : std::uint8_t { uncorrelated, natural };

class LightWaves {
  public:
    LightWaves(LightModel model, const PolarGrid& grid);

    // Frequencies m that a spectrum of the BRDF has to hold.
    [[nodiscard]] static std::uint32_t frequencies(LightModel model);

    [[nodiscard]] LightModel model() const { return model_; }
    // The light in cos mφ, and alike that in sin mφ, is a sum of columns with independent
    // coefficients of variance 1; its values are multiplied by √(w ∫ cos² mφ dφ), w the grid's
    // weights. Natural lights only.
    [[nodiscard]] const Eigen::MatrixXd& of_frequency(std::uint32_t m) const {
        return waves_[m];
    }
    // What an operator on such values, θi down its rows, makes of the light of frequency m:
    // a row a wave.
    [[nodiscard]] Eigen::MatrixXd reflected(std::uint32_t m,
                                            const Eigen::MatrixXd& of_light) const {
        return model_ == LightModel::uncorrelated
                   ? of_light
                   : Eigen::MatrixXd(waves_[m].transpose() * of_light);
    }

  private:
    LightModel model_;
    std::vector<Eigen::MatrixXd> waves_;
};

}  // namespace relume::factors
