// The best subspace of few dimensions for some vectors: principal components without a mean
// taken off, which a transport needs none of, since light times zero is black.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::lab {

// A vector a row.
using RowVectors = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Of n vectors with the Gram matrix G, n × n: orthonormal vectors of n weights, a column each,
// by falling energy. Component i of the n vectors is their sum weighted by column i, and its
// energy is energies[i] ≥ 0.
struct PrincipalWeights {
    Eigen::MatrixXf weights;
    Eigen::VectorXd energies;
};
[[nodiscard]] PrincipalWeights principal_weights(const Eigen::MatrixXd& gram);

// Orthonormal axes as rows, at most `most_axes`, fewer where the members span fewer.
struct Subspace {
    RowVectors axes;
    double missed = 0;  // Σ of squared distances of the members

    [[nodiscard]] double squared_distance(const Eigen::Ref<const Eigen::RowVectorXf>& x) const;
};
// None of the members: no axes.
[[nodiscard]] Subspace principal_subspace(const RowVectors& vectors,
                                          std::span<const std::uint32_t> members,
                                          std::size_t most_axes);

}  // namespace relume::lab
