#include "tests/lab/cpca/vertex_rows.h"

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/pilot.h"
#include "precompute/bake/blocks/shard_clusters.h"
#include "precompute/bake/mesh/mesh_subject.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/path_pool.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/bake/rows/traced_receivers.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::lab {
namespace {

// Close to each other, and as many as have much of their borders between them.
constexpr std::size_t kClustersPerRun = 16;

struct Scratch {
    std::vector<bake::CoefficientRow> terms;
    bake::ChannelRow channels;
    bake::RowBaker::Scratch rows;
};

// Room for the rows of the shards' vertices; numbers of the surface's vertices, ascending, go
// into `vertices`.
VertexRows empty_rows(const bake::VertexReceivers& receivers,
                      const basis::CubemapBasis& basis,
                      std::uint32_t channels,
                      std::span<const bake::ShardClusters> shards,
                      std::vector<std::uint32_t>& vertices) {
    const bake::RefinedSurface& surface = receivers.surface();
    VertexRows rows{.basis = basis,
                    .channels = channels,
                    .planes = {},
                    .first = {0},
                    .values = {},
                    .baked_steps = {},
                    .cluster_of = {},
                    .edges = {}};
    rows.surface_vertices = surface.vertex_count();
    rows.clusters_per_shard = receivers.clusters_per_shard();
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(surface.vertex_count(), kNone);
    for (const bake::ShardClusters& shard : shards) {
        for (std::uint32_t i = 0; i < shard.cluster_count; ++i) {
            const bake::VertexCluster& cluster = surface.clusters[shard.first_cluster + i];
            const std::uint32_t planes =
                channels * receivers.brdf_of_material(cluster.material).terms;
            for (std::uint32_t v = cluster.first; v < cluster.first + cluster.count; ++v) {
                number[v] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(v);
                rows.planes.push_back(planes);
                rows.first.push_back(rows.first.back() + planes);
                rows.cluster_of.push_back(static_cast<std::uint32_t>(rows.clusters));
            }
            ++rows.clusters;
        }
    }
    for (const std::uint32_t v : vertices) {
        for (const bake::VertexNeighbour& neighbour : surface.neighbours_of(v)) {
            if (number[neighbour.vertex] != kNone) {
                rows.edges.neighbours.push_back(number[neighbour.vertex]);
            }
        }
        rows.edges.first.push_back(static_cast<std::uint32_t>(rows.edges.neighbours.size()));
    }
    rows.values.resize(rows.first.back() * rows.columns());
    return rows;
}

// Runs of shards that are spread evenly over all.
std::vector<bake::ShardClusters> some_shards(const bake::Receivers& receivers,
                                             std::size_t most_runs) {
    const std::vector<bake::ShardClusters> all = bake::shards_of(receivers);
    const std::size_t length =
        std::max<std::size_t>(kClustersPerRun / receivers.clusters_per_shard(), 1);
    const std::size_t runs = all.size() / length;  // that are full
    if (most_runs > runs) {
        return all;
    }
    std::vector<bake::ShardClusters> some;
    for (std::size_t i = 0; i < most_runs; ++i) {
        const std::size_t first = (2 * i + 1) * runs / (2 * most_runs) * length;
        some.insert(some.end(), all.begin() + static_cast<std::ptrdiff_t>(first),
                    all.begin() + static_cast<std::ptrdiff_t>(first + length));
    }
    return some;
}

}  // namespace

std::vector<float> channel_scales(const transport::ColourModel& colour) {
    std::vector<float> scales;
    for (std::uint32_t k = 0; k < colour.channels; ++k) {
        double norm = 0;
        for (const auto& row : colour.matrix) {
            norm += double{row[k]} * row[k];
        }
        scales.push_back(static_cast<float>(std::sqrt(norm / 3)));
    }
    return scales;
}

VertexRows bake_vertex_rows(const scene::Scene& scene,
                            const bake::BakeParameters& parameters,
                            std::size_t most_runs) {
    const bake::RayCaster caster(scene);
    const bake::MeshSubject subject(caster, parameters, {}, nullptr);
    const auto& receivers = dynamic_cast<const bake::VertexReceivers&>(subject.receivers());
    const bake::LightTexels texels(parameters.face_resolution, parameters.seed);
    const bake::PathTracer tracer(caster, parameters);
    const bake::RowBaker baker(caster, texels, parameters);
    const bake::Quantisation plan = bake::plan_quantisation(
        bake::LightRows(caster, receivers, parameters), parameters.bits, parameters.seed);
    const std::uint32_t channels = plan.colour.channels;
    const std::vector<float> scales = channel_scales(plan.colour);
    const std::vector<bake::ShardClusters> shards = some_shards(receivers, most_runs);
    std::vector<std::uint32_t> vertices;
    VertexRows rows =
        empty_rows(receivers, bake::signal_basis(parameters), channels, shards, vertices);
    for (std::size_t j = 0; j < rows.columns(); ++j) {
        rows.baked_steps.push_back(plan.steps[j * channels] * scales[0]);
    }
    rows.baked_basis = plan.block_basis;
    bake::TracedReceivers traced(receivers, tracer, parameters);
    const bake::PathPool pool(traced);
    tbb::enumerable_thread_specific<Scratch> scratches;
    std::size_t first = 0;
    for (const bake::ShardClusters& shard : shards) {
        traced.move_to(shard.first_cluster, shard.cluster_count);
        std::size_t last = first;
        for (std::uint32_t i = 0; i < shard.cluster_count; ++i) {
            last += receivers.surface().clusters[shard.first_cluster + i].count;
        }
        tbb::parallel_for(first, last, [&](std::size_t v) {
            Scratch& scratch = scratches.local();
            baker.bake(traced.at(vertices[v]), &pool, scratch.terms, scratch.rows);
            float* value = &rows.values[rows.first[v] * rows.columns()];
            for (const bake::CoefficientRow& term : scratch.terms) {
                bake::split_colours(plan.colour, term, scratch.channels);
                for (std::uint32_t k = 0; k < channels; ++k) {
                    for (const float x : scratch.channels.channel[k]) {
                        *value++ = x * scales[k];
                    }
                }
            }
        });
        first = last;
    }
    return rows;
}

}  // namespace relume::lab
