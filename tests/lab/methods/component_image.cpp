#include "tests/lab/methods/component_image.h"

#include "protocol/transport/block_basis.h"
#include "tests/lab/cpca/coded_cluster.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace relume::lab {

using transport::kBlockSize;
using transport::kColours;

ComponentImageMaker::ComponentImageMaker(std::shared_ptr<const served::Scene> scene,
                                         std::shared_ptr<const ClusteredTransport> clustered,
                                         std::size_t share,
                                         std::unique_ptr<ImageMaker> surface)
    : scene_(std::move(scene)),
      clustered_(std::move(clustered)),
      share_(share),
      surface_(std::move(surface)),
      sums_(scene_->stored_operator().sum_count()) {
    for (const ClusteredTransport::Cluster& cluster : clustered_->clusters) {
        const std::size_t planes = std::size_t{cluster.terms} * kColours;
        steps_.emplace_back(cluster.weights, planes);
        answers_.emplace_back(steps_.back().components() * planes);
    }
    weigh_blocks();
}

bool ComponentImageMaker::look(const view::Look& look) {
    const bool has_changed = surface_->look(look);
    if (has_changed) {
        weigh_blocks();
    }
    return has_changed;
}

void ComponentImageMaker::weigh_blocks() {
    const std::vector<float> of_surface = surface_->block_weights();
    const transport::VertexClusters& layout = scene_->transport().manifest().layout.clusters();
    weights_.assign(clustered_->components->manifest().block_count(), 0.0F);
    for (const ClusteredTransport::Cluster& cluster : clustered_->clusters) {
        double sum = 0;
        for (const std::uint32_t vertex : cluster.members) {
            sum += of_surface[layout.place_of_vertex(vertex).block];
        }
        std::fill_n(weights_.begin() + cluster.first_block, cluster.terms,
                    static_cast<float>(sum / static_cast<double>(cluster.members.size())));
    }
}

std::uint64_t ComponentImageMaker::take(std::span<const float> sums) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, steps_.size()), std::uint64_t{0},
        [&](const tbb::blocked_range<std::size_t>& clusters, std::uint64_t bytes) {
            for (std::size_t c = clusters.begin(); c != clusters.end(); ++c) {
                bytes += take_cluster(c, sums);
            }
            return bytes;
        },
        std::plus<>());
}

std::uint64_t ComponentImageMaker::take_cluster(std::size_t c, std::span<const float> sums) {
    const ClusteredTransport::Cluster& cluster = clustered_->clusters[c];
    if (weights_[cluster.first_block] == 0) {
        return 0;
    }
    const std::size_t planes = std::size_t{cluster.terms} * kColours;
    const std::size_t components = steps_[c].components();
    const std::size_t brought = std::max<std::size_t>(components / share_, 1);
    for (std::size_t plane = 0; plane < planes; ++plane) {
        const float* own =
            &sums[(std::size_t{cluster.first_block} * kColours + plane) * kBlockSize];
        for (std::size_t i = 0; i < components; ++i) {
            answers_[c][i * planes + plane] = own[i];
        }
    }
    steps_[c].add_largest(answers_[c], brought);
    return stored_weight_bytes(cluster.members.size(), brought);
}

void ComponentImageMaker::write(std::span<float> rgb) {
    const transport::Manifest& manifest = scene_->transport().manifest();
    std::fill(sums_.begin(), sums_.end(), 0.0F);
    for (std::size_t c = 0; c < steps_.size(); ++c) {
        const std::vector<std::uint32_t>& members = clustered_->clusters[c].members;
        const std::span<const float> vertices = steps_[c].vertices();
        for (std::size_t i = 0; i < members.size(); ++i) {
            const auto place = manifest.layout.clusters().place_of_vertex(members[i]);
            for (std::size_t plane = 0; plane < place.terms * kColours; ++plane) {
                sums_[(std::size_t{place.block} * kColours + plane) * kBlockSize + place.slot] =
                    vertices[plane * members.size() + i];
            }
        }
    }
    tbb::parallel_for(std::size_t{0}, sums_.size() / kBlockSize, [&](std::size_t block) {
        transport::block_coefficients_from_receivers(
            manifest.block_basis,
            std::span<float, kBlockSize>(&sums_[block * kBlockSize], kBlockSize));
    });
    surface_->take(sums_);
    surface_->write(rgb);
}

}  // namespace relume::lab
