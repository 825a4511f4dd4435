// How the vertices of a surface are stored: in clusters, with a block for each of their terms.
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::transport {

// Neighbouring vertices of one material. Each has a row for every term of its material's
// factored BRDF (protocol/brdf), and each term of a cluster is a block.
struct Cluster {
    std::uint32_t vertices =
        0;                    // 1 … 256; vertex i of the cluster has slot i in all its blocks
    std::uint32_t terms = 0;  // 1 … kMaxTerms
    std::uint32_t material = 0;

    friend bool operator==(const Cluster&, const Cluster&) = default;
};

// Where a vertex is stored: its first term in `block`, its k-th term in block + k.
struct VertexPlace {
    std::uint32_t block = 0;
    std::uint32_t slot = 0;
    std::uint32_t terms = 0;

    friend bool operator==(const VertexPlace&, const VertexPlace&) = default;
};

// A value. Vertices are numbered from cluster to cluster; blocks are too, and within a cluster
// from term to term.
class VertexClusters {
  public:
    VertexClusters() = default;
    // Throws TransportError where a cluster has no vertices or no terms, or too many, or where
    // there are more vertices or blocks than 32 bits count.
    explicit VertexClusters(std::vector<Cluster> clusters);

    [[nodiscard]] std::span<const Cluster> clusters() const { return clusters_; }
    // Of a cluster, or, of the one past the last, how many there are.
    [[nodiscard]] std::uint32_t first_vertex(std::size_t cluster) const {
        return first_vertex_[cluster];
    }
    [[nodiscard]] std::uint32_t first_block(std::size_t cluster) const {
        return first_block_[cluster];
    }
    [[nodiscard]] std::uint32_t vertex_count() const { return first_vertex_.back(); }
    [[nodiscard]] std::uint32_t block_count() const { return first_block_.back(); }

    // Of a vertex below vertex_count(), of a block below block_count(). By bisection.
    [[nodiscard]] std::size_t cluster_of_vertex(std::uint32_t vertex) const;
    [[nodiscard]] std::size_t cluster_of_block(std::uint32_t block) const;
    [[nodiscard]] VertexPlace place_of_vertex(std::uint32_t vertex) const;

    friend bool operator==(const VertexClusters& a, const VertexClusters& b) {
        return a.clusters_ == b.clusters_;
    }

  private:
    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> first_vertex_{0};  // [clusters + 1]
    std::vector<std::uint32_t> first_block_{0};   // [clusters + 1]
};

}  // namespace relume::transport
