#include "server/view/mesh/vertex_radiance.h"

#include "protocol/transport/format.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace relume::view {

using transport::kBlockSize;
using transport::kColours;

VertexRadiance::VertexRadiance(const transport::VertexClusters& clusters,
                               transport::BlockBasis basis,
                               std::span<const float> tint)
    : clusters_(clusters), basis_(basis), tint_(tint) {
    std::size_t count = 0;
    for (const transport::Cluster& cluster : clusters.clusters()) {
        first_values_.push_back(count);
        count += kFloatsPerTerm * cluster.vertices * cluster.terms;
    }
    term_values_ = count;
    values_.assign(count, 0);
}

void VertexRadiance::take(std::span<const float> sums) {
    tbb::parallel_for(std::size_t{0}, first_values_.size(),
                      [&](std::size_t cluster) { take_cluster(sums, cluster); });
}

void VertexRadiance::take_given(const GivenRadiance& given) {
    const auto radiance = given.radiance();
    values_.resize(term_values_ + kFloatsPerTerm * radiance.size());
    tbb::parallel_for(std::size_t{0}, first_values_.size(), [&](std::size_t cluster) {
        if (!given.is_given(clusters_.clusters()[cluster].material)) {
            return;
        }
        const std::uint32_t first = clusters_.first_vertex(cluster);
        for (std::uint32_t vertex = first; vertex < clusters_.first_vertex(cluster + 1);
             ++vertex) {
            std::copy(radiance[vertex].begin(), radiance[vertex].end(),
                      &values_[term_values_ + kFloatsPerTerm * vertex]);
        }
    });
}

void VertexRadiance::take_cluster(std::span<const float> sums, std::size_t cluster) {
    const transport::Cluster& shape = clusters_.clusters()[cluster];
    const std::size_t vertex_floats = kFloatsPerTerm * shape.terms;
    std::array<float, kBlockSize> plane;
    for (std::uint32_t term = 0; term < shape.terms; ++term) {
        const std::size_t block = clusters_.first_block(cluster) + term;
        for (std::size_t colour = 0; colour < kColours; ++colour) {
            const std::size_t first = (block * kColours + colour) * kBlockSize;
            std::copy_n(&sums[first], kBlockSize, plane.begin());
            transport::block_receivers_from_coefficients(basis_, plane);
            float* const out =
                &values_[first_values_[cluster] + kFloatsPerTerm * term + colour];
            for (std::size_t slot = 0; slot < shape.vertices; ++slot) {
                out[slot * vertex_floats] = plane[slot] * tint_[first + slot];
            }
        }
    }
}

}  // namespace relume::view
