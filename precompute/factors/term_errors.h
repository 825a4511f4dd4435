// What a growing sum of azimuthal terms leaves of the lobes, in the light that it is for.
#pragma once

#include "precompute/factors/azimuthal_svd.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace relume::factors {

class TermErrors {
  public:
    // Keeps references to both.
    TermErrors(const AzimuthalSpectrum& spectrum, const LightWaves& light);

    void subtract(const AzimuthalTerm& term);
    // The means of ∫ e_l e_l' dμ(ωo) over lights, with e_l what lobe l less the terms so far
    // reflects.
    [[nodiscard]] const Eigen::MatrixXd& products() const { return products_; }

  private:
    // Of cos mφ or of sin mφ.
    struct Part {
        std::vector<Eigen::MatrixXd> lobes;
        Eigen::MatrixXd products;
    };
    [[nodiscard]] Eigen::MatrixXd products_of(std::uint32_t m,
                                              const std::vector<Eigen::MatrixXd>& lobes) const;
    [[nodiscard]] std::vector<Eigen::MatrixXd> lobes_of(std::uint32_t m) const;

    const AzimuthalSpectrum& spectrum_;
    const LightWaves& light_;
    std::map<std::pair<std::uint32_t, bool>, Part> parts_;  // those with terms
    Eigen::MatrixXd products_;
};

}  // namespace relume::factors
