// The lobes of an isotropic BRDF by azimuthal frequency. A lobe f depends on θo, θi and the
// difference Δ of azimuths alone, evenly,
//
//     f(θo, θi, Δ) = a_0 + 2 Σ_{m ≥ 1} a_m(θo, θi) cos mΔ,
//
// so that as an operator on functions of ωi it maps cos mφ to cos mφ and sin mφ to sin mφ. What
// is a matrix over all directions is thus one small matrix over polar angles for each m.
//
// Inner products are those of the measure dμ = cos θ dω on either side.
#pragma once

#include "precompute/factors/brdf_lobes.h"
#include "precompute/factors/polar_grid.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::factors {

class AzimuthalSpectrum {
  public:
    // Samples the lobes on `rows` polar angles, on all cores. Every a_m of m < `frequencies` is
    // an integral over Δ by a rule whose points crowd where the mirror direction is. Memory:
    // 8·lobes·frequencies·rows² bytes.
    AzimuthalSpectrum(const BrdfLobes& lobes, std::uint32_t rows, std::uint32_t frequencies);

    [[nodiscard]] const PolarGrid& grid() const { return grid_; }
    [[nodiscard]] std::size_t lobes() const { return lobes_; }
    [[nodiscard]] std::uint32_t frequencies() const { return frequencies_; }
    // 2π·√(w(θi) w(θo))·a_m(θo, θi), θi down its rows and θo along its columns, w the grid's
    // weights: the operator between functions that are orthonormal.
    [[nodiscard]] const Eigen::MatrixXd& matrix(std::size_t lobe, std::uint32_t m) const {
        return matrices_[lobe * frequencies_ + m];
    }
    // ∬ f_l f_l' dμ(ωi) dμ(ωo), of all frequencies.
    [[nodiscard]] const Eigen::MatrixXd& products() const { return products_; }

  private:
    PolarGrid grid_;
    std::size_t lobes_;
    std::uint32_t frequencies_;
    std::vector<Eigen::MatrixXd> matrices_;
    Eigen::MatrixXd products_;
};

// Σ_l,l' (colour_l · colour_l')·products(l, l'): the square of a norm over red, green and blue.
[[nodiscard]] double square_in_colour(const std::vector<Imath::V3f>& colours,
                                      const Eigen::MatrixXd& products);

}  // namespace relume::factors
