#include "tests/lab/cpca/subspace.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace relume::lab {
namespace {

// Components with less of the energy than this are rounding.
constexpr double kRounding = 1e-12;

}  // namespace

PrincipalWeights principal_weights(const Eigen::MatrixXd& gram) {
    if (gram.rows() == 0) {
        return {.weights = Eigen::MatrixXf(0, 0), .energies = Eigen::VectorXd(0)};
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    return {.weights = solver.eigenvectors().rowwise().reverse().cast<float>(),
            .energies = solver.eigenvalues().reverse().cwiseMax(0)};
}

double Subspace::squared_distance(const Eigen::Ref<const Eigen::RowVectorXf>& x) const {
    const Eigen::VectorXf along = axes * x.transpose();
    return std::max(0.0, double{x.squaredNorm()} - double{along.squaredNorm()});
}

Subspace principal_subspace(const RowVectors& vectors,
                            std::span<const std::uint32_t> members,
                            std::size_t most_axes) {
    const auto count = static_cast<Eigen::Index>(members.size());
    RowVectors own(count, vectors.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
        own.row(i) = vectors.row(members[static_cast<std::size_t>(i)]);
    }
    const Eigen::MatrixXd precise = own.cast<double>();
    const PrincipalWeights principal = principal_weights(precise * precise.transpose());
    const double energy = principal.energies.sum();
    Eigen::Index axes = 0;
    while (axes < std::min(count, static_cast<Eigen::Index>(most_axes)) &&
           principal.energies[axes] > kRounding * energy) {
        ++axes;
    }
    Subspace subspace;
    subspace.axes = principal.weights.leftCols(axes).transpose() * own;
    for (Eigen::Index i = 0; i < axes; ++i) {
        // Against what is rounded in the sum: later axes are small beside earlier ones.
        for (int pass = 0; pass < 2; ++pass) {
            const Eigen::VectorXf along =
                subspace.axes.topRows(i) * subspace.axes.row(i).transpose();
            subspace.axes.row(i) -= along.transpose() * subspace.axes.topRows(i);
            subspace.axes.row(i).normalize();
        }
    }
    for (Eigen::Index i = 0; i < count; ++i) {
        subspace.missed += subspace.squared_distance(own.row(i));
    }
    return subspace;
}

}  // namespace relume::lab
