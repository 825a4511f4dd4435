#include "precompute/bake/blocks/sample_clusters.h"

#include "protocol/transport/hash.h"

#include <algorithm>

namespace relume::bake {

std::vector<std::uint32_t> sample_clusters(const Receivers& receivers,
                                           const SampleCount& count,
                                           std::uint64_t seed) {
    std::vector<std::uint32_t> clusters;
    std::vector<std::uint32_t> occupied;
    for (std::uint32_t cluster = 0; cluster < receivers.cluster_count(); ++cluster) {
        clusters.push_back(cluster);
        if (!receivers.look(receivers.middle_of_cluster(cluster)).surfaces.empty()) {
            occupied.push_back(cluster);
        }
    }
    const std::vector<std::uint32_t>& from = occupied.empty() ? clusters : occupied;
    const std::size_t wanted =
        std::min(std::clamp<std::size_t>(from.size() / count.every, count.least, count.most),
                 from.size());
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = 0; i < wanted; ++i) {
        const double jitter = double{transport::unit_float(transport::mix_bits(seed + i))};
        const double place = (static_cast<double>(i) + jitter) / static_cast<double>(wanted);
        chosen.push_back(
            from[static_cast<std::size_t>(place * static_cast<double>(from.size()))]);
    }
    return chosen;
}

}  // namespace relume::bake
