#include "tests/lab/cpca/clustered_transport.h"

#include "precompute/bake/blocks/light_model.h"
#include "protocol/transport/transport_writer.h"
#include "tests/lab/cpca/coded_cluster.h"
#include "tests/lab/cpca/reassignment.h"
#include "tests/lab/cpca/row_sketch.h"
#include "tests/lab/cpca/transport_rows.h"
#include "tests/support/scratch_directory.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

using transport::kBlockSize;
using transport::kColours;

constexpr std::size_t kSketchNumbers = 2048;
constexpr std::uint64_t kSketchSeed = 1;

std::vector<std::uint32_t> reassigned_clusters(const VertexRows& rows,
                                               const ClusterOptions& options) {
    return reassign(sketch_rows(rows, bake::kNaturalFalloff, kSketchNumbers, kSketchSeed),
                    rows.edges, halved_clusters(rows.cluster_of, options.clusters),
                    options.clusters, {.capacity = kBlockSize, .axes = options.bases})
        .cluster_of;
}

// A cluster, and its blocks as encoded.
struct Learned {
    ClusteredTransport::Cluster cluster;
    std::vector<transport::EncodedBlock> blocks;
};

Learned learn(const VertexRows& rows,
              const LightWeights& lights,
              const std::vector<std::uint32_t>& members,
              std::size_t bases) {
    const CodedCluster coded(rows, members, ClusterBasis::learned, bake::kNaturalFalloff,
                             lights);
    const std::size_t components = std::min(bases, coded.width());
    const RowVectors no_light = RowVectors::Zero(static_cast<Eigen::Index>(rows.columns()), 1);
    return {
        .cluster = {.members = members,
                    .terms = coded.planes() / rows.channels,
                    .weights = coded.weights().leftCols(static_cast<Eigen::Index>(components))},
        .blocks = coded.encode(rows.baked_steps, components, no_light).blocks};
}

// [blocks][3][256]: how far a component's unit changes the cluster's vertices, whose tints may
// differ. The engine ranks and estimates by it, and sums are before tint.
void add_tint(const transport::Transport& of,
              const ClusteredTransport::Cluster& cluster,
              std::vector<float>& tint) {
    const transport::VertexClusters& clusters = of.manifest().layout.clusters();
    for (std::uint32_t term = 0; term < cluster.terms; ++term) {
        for (std::size_t c = 0; c < kColours; ++c) {
            std::vector<float> own(kBlockSize, 1.0F);
            for (Eigen::Index i = 0; i < cluster.weights.cols(); ++i) {
                double energy = 0;
                for (std::size_t m = 0; m < cluster.members.size(); ++m) {
                    const auto place = clusters.place_of_vertex(cluster.members[m]);
                    const double change =
                        double{cluster.weights(static_cast<Eigen::Index>(m), i)} *
                        of.tint()[(std::size_t{place.block + term} * kColours + c) *
                                      kBlockSize +
                                  place.slot];
                    energy += change * change;
                }
                own[static_cast<std::size_t>(i)] = static_cast<float>(std::sqrt(energy));
            }
            tint.insert(tint.end(), own.begin(), own.end());
        }
    }
}

// Blocks in rows of tiles, the last of which is filled up.
transport::TileGrid tiles_of(std::uint32_t blocks) {
    constexpr std::uint32_t kTilesAcross = 64;
    const std::uint32_t across = std::min(blocks, kTilesAcross);
    return {.width = across * transport::kTileSide,
            .height = (blocks + across - 1) / across * transport::kTileSide};
}

transport::EncodedBlock empty_block(std::size_t segments) {
    transport::EncodedBlock block(segments);
    for (std::size_t segment = 0; segment < segments; ++segment) {
        block.append({});
    }
    return block;
}

transport::Manifest manifest_of(const transport::Transport& of, std::uint32_t blocks) {
    transport::Manifest manifest = of.manifest();
    manifest.kind = transport::Kind::image;
    manifest.layout = transport::ReceiverLayout::pixel_tiles(tiles_of(blocks));
    manifest.block_basis = transport::BlockBasis::haar_tile;
    manifest.mesh.reset();
    manifest.sampling_error.reset();
    return manifest;
}

// Shards hold as many clusters as those of the surface.
transport::ShardPlan plan_of(const ClusteredTransport& clustered,
                             std::size_t clusters_per_shard,
                             std::uint32_t all_blocks) {
    transport::ShardPlan plan;
    std::uint32_t blocks = 0;
    std::uint32_t planned = 0;
    const auto close = [&] {
        if (blocks > 0) {
            plan.add(blocks);
            planned += blocks;
            blocks = 0;
        }
    };
    for (std::size_t c = 0; c < clustered.clusters.size(); ++c) {
        const std::uint32_t terms = clustered.clusters[c].terms;
        if (c % clusters_per_shard == 0 || blocks + terms > transport::kMaxBlocksPerShard) {
            close();
        }
        blocks += terms;
    }
    close();
    while (planned < all_blocks) {  // what fills up the last row of tiles
        blocks = std::min(all_blocks - planned, transport::kMaxBlocksPerShard);
        close();
    }
    return plan;
}

std::shared_ptr<const transport::Transport> write_components(
    const transport::Transport& of,
    const ClusteredTransport& clustered,
    std::size_t clusters_per_shard,
    std::vector<transport::EncodedBlock> blocks) {
    const transport::Manifest manifest =
        manifest_of(of, static_cast<std::uint32_t>(blocks.size()));
    transport::BakedTables tables;
    for (std::size_t j = 0; j < of.column_count(); ++j) {
        for (std::uint32_t k = 0; k < of.channel_count(); ++k) {
            tables.steps.push_back(of.step(j, k));
        }
    }
    for (const ClusteredTransport::Cluster& cluster : clustered.clusters) {
        add_tint(of, cluster, tables.tint);
    }
    tables.tint.resize(manifest.layout.slot_count() * kColours, 1.0F);
    tables.coverage.resize(manifest.layout.slot_count(), 1.0F);
    while (blocks.size() < manifest.block_count()) {
        blocks.push_back(empty_block(of.column_count() * of.channel_count()));
    }
    const test::ScratchDirectory scratch;
    const std::filesystem::path directory = scratch.path() / "components.relume";
    transport::TransportWriter writer(
        directory, manifest, plan_of(clustered, clusters_per_shard, manifest.block_count()));
    auto block = blocks.begin();
    for (std::uint32_t shard = 0; shard < writer.plan().shard_count(); ++shard) {
        const auto end = block + writer.plan().blocks_in(shard);
        writer.write_shard(shard,
                           {std::make_move_iterator(block), std::make_move_iterator(end)});
        block = end;
    }
    writer.finish(tables, nlohmann::json::object());
    return transport::Transport::open(directory);
}

}  // namespace

std::vector<std::uint32_t> halved_clusters(std::span<const std::uint32_t> cluster_of,
                                           std::size_t clusters) {
    const std::size_t before =
        cluster_of.empty() ? 0 : *std::max_element(cluster_of.begin(), cluster_of.end()) + 1U;
    if (clusters < before || clusters > cluster_of.size()) {
        throw std::invalid_argument(
            fmt::format("{} clusters of {} vertices, expected {} or more, and no more than "
                        "vertices",
                        clusters, cluster_of.size(), before));
    }
    std::vector<std::vector<std::uint32_t>> members = members_of(cluster_of, before);
    while (members.size() < clusters) {
        const auto largest =
            std::max_element(members.begin(), members.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
        const auto half = static_cast<std::ptrdiff_t>((largest->size() + 1) / 2);
        std::vector<std::uint32_t> second(largest->begin() + half, largest->end());
        largest->resize(static_cast<std::size_t>(half));
        members.push_back(std::move(second));
    }
    std::vector<std::uint32_t> halved(cluster_of.size());
    for (std::size_t c = 0; c < members.size(); ++c) {
        for (const std::uint32_t vertex : members[c]) {
            halved[vertex] = static_cast<std::uint32_t>(c);
        }
    }
    return halved;
}

ClusteredTransport clustered_transport(const transport::Transport& of,
                                       const ClusterOptions& options) {
    if (options.bases == 0) {
        throw std::invalid_argument("0 bases a cluster, expected 1 or more");
    }
    const VertexRows rows = rows_of_transport(of);
    const LightWeights lights(rows.basis);
    const auto members = members_of(reassigned_clusters(rows, options), options.clusters);
    std::vector<Learned> learned(members.size());
    tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t c) {
        if (!members[c].empty()) {
            learned[c] = learn(rows, lights, members[c], options.bases);
        }
    });
    ClusteredTransport clustered;
    std::vector<transport::EncodedBlock> blocks;
    for (Learned& one : learned) {
        if (one.blocks.empty()) {
            continue;
        }
        one.cluster.first_block = static_cast<std::uint32_t>(blocks.size());
        std::move(one.blocks.begin(), one.blocks.end(), std::back_inserter(blocks));
        clustered.clusters.push_back(std::move(one.cluster));
    }
    clustered.components =
        write_components(of, clustered, rows.clusters_per_shard, std::move(blocks));
    return clustered;
}

}  // namespace relume::lab
