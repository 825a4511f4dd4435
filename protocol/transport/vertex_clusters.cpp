#include "protocol/transport/vertex_clusters.h"

#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace relume::transport {
namespace {

// Of ascending beginnings, the last of them that is at most `value`.
std::size_t last_beginning(const std::vector<std::uint32_t>& beginnings, std::uint32_t value) {
    const auto after = std::upper_bound(beginnings.begin(), beginnings.end(), value);
    return static_cast<std::size_t>(after - beginnings.begin()) - 1;
}

std::uint32_t require_count(std::uint64_t count, const char* what) {
    if (count > std::numeric_limits<std::int32_t>::max()) {
        throw TransportError(fmt::format("clusters: found {} {}, expected at most {}", count,
                                         what, std::numeric_limits<std::int32_t>::max()));
    }
    return static_cast<std::uint32_t>(count);
}

}  // namespace

VertexClusters::VertexClusters(std::vector<Cluster> clusters) : clusters_(std::move(clusters)) {
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
        const Cluster& cluster = clusters_[i];
        if (cluster.vertices < 1 || cluster.vertices > kBlockSize) {
            throw TransportError(
                fmt::format("clusters[{}]: found {} vertices, expected 1 to {}", i,
                            cluster.vertices, kBlockSize));
        }
        if (cluster.terms < 1 || cluster.terms > kMaxTerms) {
            throw TransportError(fmt::format("clusters[{}]: found {} terms, expected 1 to {}",
                                             i, cluster.terms, kMaxTerms));
        }
        first_vertex_.push_back(
            require_count(std::uint64_t{first_vertex_.back()} + cluster.vertices, "vertices"));
        first_block_.push_back(
            require_count(std::uint64_t{first_block_.back()} + cluster.terms, "blocks"));
    }
}

std::size_t VertexClusters::cluster_of_vertex(std::uint32_t vertex) const {
    return last_beginning(first_vertex_, vertex);
}

std::size_t VertexClusters::cluster_of_block(std::uint32_t block) const {
    return last_beginning(first_block_, block);
}

VertexPlace VertexClusters::place_of_vertex(std::uint32_t vertex) const {
    const std::size_t cluster = cluster_of_vertex(vertex);
    return {.block = first_block_[cluster],
            .slot = vertex - first_vertex_[cluster],
            .terms = clusters_[cluster].terms};
}

}  // namespace relume::transport
