#include "precompute/factors/term_errors.h"

#include <cmath>

namespace relume::factors {

TermErrors::TermErrors(const AzimuthalSpectrum& spectrum, const LightWaves& light)
    : spectrum_(spectrum), light_(light), products_(spectrum.products()) {
    if (light.model() == LightModel::natural) {
        products_.setZero();
        for (std::uint32_t m = 0; m < spectrum.frequencies(); ++m) {
            products_ += (m == 0 ? 1 : 2) * products_of(m, lobes_of(m));
        }
    }
}

std::vector<Eigen::MatrixXd> TermErrors::lobes_of(std::uint32_t m) const {
    std::vector<Eigen::MatrixXd> lobes;
    for (std::size_t lobe = 0; lobe < spectrum_.lobes(); ++lobe) {
        lobes.push_back(spectrum_.matrix(lobe, m));
    }
    return lobes;
}

Eigen::MatrixXd TermErrors::products_of(std::uint32_t m,
                                        const std::vector<Eigen::MatrixXd>& lobes) const {
    std::vector<Eigen::MatrixXd> reflected;
    for (const Eigen::MatrixXd& lobe : lobes) {
        reflected.push_back(light_.reflected(m, lobe));
    }
    Eigen::MatrixXd products(lobes.size(), lobes.size());
    for (Eigen::Index a = 0; a < products.rows(); ++a) {
        for (Eigen::Index b = 0; b < products.cols(); ++b) {
            products(a, b) = reflected[static_cast<std::size_t>(a)]
                                 .cwiseProduct(reflected[static_cast<std::size_t>(b)])
                                 .sum();
        }
    }
    return products;
}

void TermErrors::subtract(const AzimuthalTerm& term) {
    const auto [at, is_new] = parts_.try_emplace({term.frequency, term.is_sine});
    Part& part = at->second;
    if (is_new) {
        part.lobes = lobes_of(term.frequency);
        part.products = products_of(term.frequency, part.lobes);
    }
    const std::vector<double>& weights = spectrum_.grid().weights;
    const Eigen::VectorXd scales =
        (Eigen::Map<const Eigen::VectorXd>(weights.data(),
                                           static_cast<Eigen::Index>(weights.size())) *
         azimuthal_square(term.frequency))
            .cwiseSqrt();
    const Eigen::VectorXd g = scales.cwiseProduct(term.g);
    const Eigen::MatrixXd h = scales.asDiagonal() * term.h;
    for (std::size_t lobe = 0; lobe < part.lobes.size(); ++lobe) {
        part.lobes[lobe] -= g * h.col(static_cast<Eigen::Index>(lobe)).transpose();
    }
    products_ -= part.products;
    part.products = products_of(term.frequency, part.lobes);
    products_ += part.products;
}

}  // namespace relume::factors
