#include "tests/lab/cpca/transport_rows.h"

#include "protocol/transport/block_basis.h"
#include "tests/lab/geometry/segment_cells.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

namespace relume::lab {
namespace {

using transport::kBlockSize;

// Those of one cache line of a row.
constexpr std::size_t kColumnsAtOnce = 16;

VertexGraph edges_of(const transport::SurfaceMesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
    for (const transport::SurfaceTriangle& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = triangle.vertices[i];
            const std::uint32_t b = triangle.vertices[(i + 1) % 3];
            ends.emplace_back(a, b);
            ends.emplace_back(b, a);
        }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    VertexGraph graph;
    auto end = ends.begin();
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        for (; end != ends.end() && end->first == v; ++end) {
            graph.neighbours.push_back(end->second);
        }
        graph.first.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
    }
    return graph;
}

VertexRows empty_rows(const transport::Transport& transport, std::span<const float> scales) {
    const transport::VertexClusters& clusters = transport.manifest().layout.clusters();
    VertexRows rows;
    rows.basis = transport.manifest().signal_basis.cubemap();
    rows.channels = transport.channel_count();
    rows.surface_vertices = clusters.vertex_count();
    rows.clusters = clusters.clusters().size();
    for (std::size_t c = 0; c < rows.clusters; ++c) {
        const transport::Cluster& cluster = clusters.clusters()[c];
        for (std::uint32_t i = 0; i < cluster.vertices; ++i) {
            rows.planes.push_back(cluster.terms * rows.channels);
            rows.first.push_back(rows.first.back() + rows.planes.back());
            rows.cluster_of.push_back(static_cast<std::uint32_t>(c));
        }
    }
    for (std::size_t j = 0; j < transport.column_count(); ++j) {
        rows.baked_steps.push_back(transport.step(j, 0) * scales[0]);
    }
    rows.edges = edges_of(transport.surface()->mesh);
    rows.clusters_per_shard =
        1 + clusters.cluster_of_block(transport.shards().front().block_count() - 1);
    rows.values.resize(rows.first.back() * rows.columns());
    return rows;
}

// One channel of neighbouring columns of a shard, as values of vertices.
class ShardColumns {
  public:
    ShardColumns(const transport::Transport& transport, const transport::ShardReader& shard)
        : transport_(transport), shard_(shard), values_(shard.block_count() * kColumnsAtOnce) {}

    void read(std::size_t first, std::size_t count, std::uint32_t channel) {
        std::fill(values_.begin(), values_.end(), transport::DecodedCell{});
        for (std::size_t j = 0; j < count; ++j) {
            for_each_cell(shard_.segment(first + j, channel), shard_.block_count(), cell_,
                          [&](std::uint32_t block, const transport::DecodedCell& cell) {
                              transport::DecodedCell& values =
                                  values_[block * kColumnsAtOnce + j];
                              const float step = transport_.step(first + j, channel);
                              std::transform(cell.begin(), cell.end(), values.begin(),
                                             [step](float value) { return value * step; });
                              transport::block_receivers_from_coefficients(
                                  transport_.manifest().block_basis, values);
                          });
        }
    }
    [[nodiscard]] float value(std::uint32_t block, std::size_t j, std::uint32_t slot) const {
        return values_[block * kColumnsAtOnce + j][slot];
    }

  private:
    const transport::Transport& transport_;
    const transport::ShardReader& shard_;
    std::vector<transport::DecodedCell> values_;  // [blocks][columns]
    transport::DecodedCell cell_{};
};

void fill_shard(const transport::Transport& transport,
                const transport::ShardReader& shard,
                std::span<const float> scales,
                VertexRows& rows) {
    const transport::VertexClusters& clusters = transport.manifest().layout.clusters();
    ShardColumns columns(transport, shard);
    for (std::size_t first = 0; first < rows.columns(); first += kColumnsAtOnce) {
        const std::size_t count = std::min(kColumnsAtOnce, rows.columns() - first);
        for (std::uint32_t k = 0; k < rows.channels; ++k) {
            columns.read(first, count, k);
            for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
                const std::uint32_t number = shard.first_block() + block;
                const std::size_t cluster = clusters.cluster_of_block(number);
                const std::uint32_t term = number - clusters.first_block(cluster);
                for (std::uint32_t i = 0; i < clusters.clusters()[cluster].vertices; ++i) {
                    const std::size_t plane = rows.first[clusters.first_vertex(cluster) + i] +
                                              std::size_t{term} * rows.channels + k;
                    float* out = &rows.values[plane * rows.columns() + first];
                    for (std::size_t j = 0; j < count; ++j) {
                        out[j] = scales[k] * columns.value(block, j, i);
                    }
                }
            }
        }
    }
}

}  // namespace

VertexRows rows_of_transport(const transport::Transport& transport) {
    if (!transport.surface()) {
        throw std::invalid_argument(
            fmt::format("{}: no surface, expected kind mesh", transport.directory().string()));
    }
    const std::vector<float> scales = channel_scales(transport.manifest().colour);
    VertexRows rows = empty_rows(transport, scales);
    tbb::parallel_for(std::size_t{0}, transport.shards().size(), [&](std::size_t shard) {
        fill_shard(transport, transport.shards()[shard], scales, rows);
    });
    return rows;
}

}  // namespace relume::lab
