// A surface's transport in the principal components of clusters of its vertices [Sloan03,
// Liu04; Overbeck06T §7.3], ready to be relit by the engine.
#pragma once

#include "protocol/transport/transport.h"
#include "tests/lab/cpca/subspace.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::lab {

struct ClusteredTransport {
    // Blocks first_block, first_block + 1 … of `components` are its terms; component i of the
    // cluster has slot i in each.
    struct Cluster {
        std::vector<std::uint32_t> members;  // vertices, ascending
        std::uint32_t terms = 0;
        std::uint32_t first_block = 0;
        Eigen::MatrixXf weights;  // [members][S], orthonormal columns, as stored
    };

    std::vector<Cluster> clusters;
    // From light to components: of the signal, colours and steps of the surface's own
    // transport. Its kind is image, a block taking the place of a tile.
    std::shared_ptr<const transport::Transport> components;
};

struct ClusterOptions {
    std::size_t clusters = 0;  // C
    std::size_t bases = 0;     // S, or as many as a cluster has vertices
};

// Each of `cluster_of`'s clusters is halved, in the order of its vertices and the largest
// first, until there are so many. None has more than one vertex more than before. Throws
// std::invalid_argument where there are more already, or fewer vertices.
[[nodiscard]] std::vector<std::uint32_t> halved_clusters(
    std::span<const std::uint32_t> cluster_of, std::size_t clusters);

// Of the stored rows of a transport of kind mesh. Its own clusters are halved until there are
// C, and then reassigned (reassignment.h); each is given its S best components in natural
// light, and these are quantised with the transport's own steps. Some clusters may have no
// vertices left and take no part. Memory: eight bytes a value of the rows. Depends on nothing
// but its arguments. Throws std::invalid_argument for another kind, and as halved_clusters.
[[nodiscard]] ClusteredTransport clustered_transport(const transport::Transport& of,
                                                     const ClusterOptions& options);

}  // namespace relume::lab
