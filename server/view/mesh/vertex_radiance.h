// What the vertices of a mesh have been given: the radiance of each of their terms.
#pragma once

#include "protocol/transport/block_basis.h"
#include "protocol/transport/vertex_clusters.h"
#include "server/view/mesh/given_radiance.h"

#include <cstddef>
#include <span>
#include <vector>

namespace relume::view {

// Red, green, blue and a 0 for every term of every vertex (DrawnSurface::first_term), and
// behind all terms, where radiance is given, of every vertex (DrawnSurface::given_term). This is
// all of the light that a client needs which draws the mesh by itself.
//
// Not thread-safe, but for what is const.
class VertexRadiance {
  public:
    static constexpr std::size_t kFloatsPerTerm = 4;

    // Keeps a reference to the clusters. `tint`: [blocks][3][256].
    VertexRadiance(const transport::VertexClusters& clusters,
                   transport::BlockBasis basis,
                   std::span<const float> tint);

    // From sums, [blocks][3][256], in the basis of the blocks and before tint. Spread over the
    // caller's arena.
    void take(std::span<const float> sums);
    // In place of what was given before.
    void take_given(const GivenRadiance& given);
    [[nodiscard]] std::span<const float> values() const { return values_; }

  private:
    void take_cluster(std::span<const float> sums, std::size_t cluster);

    const transport::VertexClusters& clusters_;
    transport::BlockBasis basis_;
    std::span<const float> tint_;
    std::vector<std::size_t> first_values_;  // of every cluster
    std::size_t term_values_ = 0;            // of all terms
    std::vector<float> values_;
};

}  // namespace relume::view
