#include "server/view/mesh/block_weights.h"

#include "server/view/mesh/corner_counts.h"

#include <algorithm>
#include <cstdint>

namespace relume::view {

std::vector<float> block_weights(const DrawnSurface& surface,
                                 const VisibleSurface& visible,
                                 const GivenRadiance* given) {
    const std::span<const transport::Cluster> clusters = surface.clusters().clusters();
    const CornerCounts counts = corner_counts(
        surface.mesh(), visible, clusters.size(),
        [&](std::uint32_t vertex) { return surface.cluster(vertex); });
    std::vector<float> weights;
    weights.reserve(surface.clusters().block_count());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const bool counts_here = given == nullptr || !given->is_given(clusters[i].material);
        const float weight = counts_here
                                 ? pixels_from_places(counts[i]) /
                                       static_cast<float>(clusters[i].vertices)
                                 : 0;
        weights.insert(weights.end(), clusters[i].terms, weight);
    }
    if (std::all_of(weights.begin(), weights.end(), [](float weight) { return weight == 0; })) {
        weights.assign(weights.size(), 1);
    }
    return weights;
}

}  // namespace relume::view
