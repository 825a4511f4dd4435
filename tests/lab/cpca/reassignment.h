// Clusters whose vertices lie near a common subspace: k-means with subspaces for means
// [Sloan03].
#pragma once

#include "tests/lab/cpca/subspace.h"
#include "tests/lab/cpca/vertex_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

struct ReassignmentOptions {
    std::size_t capacity = 256;  // vertices of a cluster
    std::size_t axes = 24;       // S
    std::size_t most_rounds = 12;
};

struct Reassignment {
    std::vector<std::uint32_t> cluster_of;  // [V]
    // Σ of squared distances to the clusters' subspaces: before, and after each round. Never
    // rises.
    std::vector<double> errors;
};

// In a round every vertex may move to a cluster that an edge leads to from its own, and whose
// subspace misses it by less: those that gain most go first. Where that cluster is full, it
// gives one of its vertices in exchange, if both moves together gain. Then subspaces are found
// anew, and each kept as it was where rounding would make the new one worse. Ends when a round
// gains less than a thousandth. `clusters` may be empty or have fewer vertices than axes. Edges
// never lead to a vertex with a row of another length. Depends on nothing but the arguments,
// on any number of threads.
[[nodiscard]] Reassignment reassign(const RowVectors& vectors,
                                    const VertexGraph& graph,
                                    std::span<const std::uint32_t> cluster_of,
                                    std::size_t clusters,
                                    const ReassignmentOptions& options);

// Vertices of every cluster, ascending.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> members_of(
    std::span<const std::uint32_t> cluster_of, std::size_t clusters);

}  // namespace relume::lab
