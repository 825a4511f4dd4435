#include "tests/lab/geometry/leading_terms.h"

#include "protocol/transport/transport_writer.h"
#include "tests/lab/geometry/segment_cells.h"
#include "tests/support/scratch_directory.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace relume::lab {
namespace {

using transport::kBlockSize;
using transport::kColours;

// The first `kept` of every `depth` values.
std::vector<float> leading_values(std::span<const float> values,
                                  std::uint32_t depth,
                                  std::uint32_t kept) {
    std::vector<float> leading;
    for (std::size_t first = 0; first < values.size(); first += depth) {
        const auto from = values.begin() + static_cast<std::ptrdiff_t>(first);
        leading.insert(leading.end(), from, from + kept);
    }
    return leading;
}

brdf::FactoredBrdf leading_terms_of(const brdf::FactoredBrdf& brdf, std::uint32_t terms) {
    brdf::FactoredBrdf leading = brdf;
    leading.terms = std::min(terms, brdf.terms);
    const auto table = [&](const brdf::DirectionTable& of, std::uint32_t kept) {
        brdf::TableShape shape = of.shape();
        std::vector<float> values = leading_values(of.values(), shape.depth, kept);
        shape.depth = kept;
        return brdf::DirectionTable(shape, std::move(values));
    };
    leading.g = table(brdf.g, leading.terms);
    leading.h = table(brdf.h, leading.terms * brdf.lobes);
    return leading;
}

// The blocks of `clusters` that are kept, in their order.
std::vector<std::uint32_t> kept_blocks(const transport::VertexClusters& clusters,
                                       std::uint32_t terms) {
    std::vector<std::uint32_t> kept;
    for (std::size_t c = 0; c < clusters.clusters().size(); ++c) {
        for (std::uint32_t k = 0; k < std::min(terms, clusters.clusters()[c].terms); ++k) {
            kept.push_back(clusters.first_block(c) + k);
        }
    }
    return kept;
}

// [blocks][values], of the blocks that are kept.
std::vector<float> of_blocks(std::span<const float> table,
                             std::size_t values,
                             std::span<const std::uint32_t> blocks) {
    std::vector<float> some;
    for (const std::uint32_t block : blocks) {
        const auto own = table.subspan(block * values, values);
        some.insert(some.end(), own.begin(), own.end());
    }
    return some;
}

// All columns of a shard's blocks.
std::vector<transport::EncodedBlock> blocks_of(const transport::Transport& of,
                                               const transport::ShardReader& shard) {
    const std::uint32_t channels = of.channel_count();
    std::vector<transport::EncodedBlock> blocks(
        shard.block_count(), transport::EncodedBlock(of.column_count() * channels));
    transport::DecodedCell values{};
    std::vector<transport::QuantisedCell> cells(shard.block_count());
    for (std::size_t j = 0; j < of.column_count(); ++j) {
        for (std::uint32_t k = 0; k < channels; ++k) {
            std::fill(cells.begin(), cells.end(), transport::QuantisedCell{});
            for_each_cell(shard.segment(j, k), shard.block_count(), values,
                          [&](std::uint32_t block, const transport::DecodedCell& cell) {
                              for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                                  cells[block][slot] =
                                      static_cast<std::int32_t>(std::lround(cell[slot]));
                              }
                          });
            for (std::size_t block = 0; block < blocks.size(); ++block) {
                blocks[block].append(cells[block]);
            }
        }
    }
    return blocks;
}

}  // namespace

std::shared_ptr<const transport::Transport> leading_terms(const transport::Transport& of,
                                                          std::uint32_t terms) {
    if (!of.surface() || terms == 0) {
        throw std::invalid_argument(fmt::format(
            "{}: {} terms of kind {}, expected 1 or more of kind mesh", of.directory().string(),
            terms, transport::kKindNames.name(of.manifest().kind)));
    }
    const transport::VertexClusters& clusters = of.manifest().layout.clusters();
    transport::Manifest manifest = of.manifest();
    manifest.visibility.reset();
    std::vector<transport::Cluster> fewer(clusters.clusters().begin(),
                                          clusters.clusters().end());
    for (transport::Cluster& cluster : fewer) {
        cluster.terms = std::min(cluster.terms, terms);
    }
    manifest.layout =
        transport::ReceiverLayout::vertex_clusters(transport::VertexClusters(std::move(fewer)));
    const std::vector<std::uint32_t> kept = kept_blocks(clusters, terms);
    transport::ShardPlan plan;
    std::vector<std::vector<transport::EncodedBlock>> shards;
    for (const transport::ShardReader& shard : of.shards()) {
        std::vector<transport::EncodedBlock> blocks = blocks_of(of, shard);
        std::vector<transport::EncodedBlock>& some = shards.emplace_back();
        for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
            if (std::binary_search(kept.begin(), kept.end(), shard.first_block() + block)) {
                some.push_back(std::move(blocks[block]));
            }
        }
        if (some.empty()) {
            shards.pop_back();
        } else {
            plan.add(static_cast<std::uint32_t>(some.size()));
        }
    }
    transport::Surface surface = *of.surface();
    for (brdf::FactoredBrdf& brdf : surface.brdfs) {
        brdf = leading_terms_of(brdf, terms);
    }
    const test::ScratchDirectory scratch;
    transport::TransportWriter writer(scratch.path() / "leading.relume", manifest, plan);
    for (std::uint32_t shard = 0; shard < plan.shard_count(); ++shard) {
        writer.write_shard(shard, shards[shard]);
    }
    writer.write_surface(surface);
    transport::BakedTables tables;
    for (std::size_t j = 0; j < of.column_count(); ++j) {
        for (std::uint32_t k = 0; k < of.channel_count(); ++k) {
            tables.steps.push_back(of.step(j, k));
        }
    }
    tables.coverage = of_blocks(of.coverage(), kBlockSize, kept);
    tables.tint = of_blocks(of.tint(), kColours * kBlockSize, kept);
    writer.finish(tables, nlohmann::json::object());
    return transport::Transport::open(scratch.path() / "leading.relume");
}

}  // namespace relume::lab
