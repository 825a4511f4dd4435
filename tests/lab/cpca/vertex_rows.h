// The float rows of a scene's surface: what relume-bake makes of vertices before anything is
// quantised.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/scene/scene.h"
#include "protocol/basis/cubemap_basis.h"
#include "protocol/transport/block_basis.h"
#include "protocol/transport/colour_model.h"
#include "tests/lab/cpca/vertex_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

struct VertexRows {
    basis::CubemapBasis basis;  // of N coefficients
    std::uint32_t channels = 1;
    std::vector<std::uint32_t> planes;  // [V], terms × channels of each vertex
    std::vector<std::size_t> first{0};  // [V + 1], in planes
    // A vertex's planes in turn, terms outermost, of N values each. Channels are scaled so that
    // an error weighs alike in all of them.
    std::vector<float> values;
    // The bake's own step of every coefficient, [N], in these units, and the basis of its
    // blocks.
    std::vector<float> baked_steps;
    transport::BlockBasis baked_basis = transport::BlockBasis::haar_line;

    // [V], in which they are baked; each of one material.
    std::vector<std::uint32_t> cluster_of;
    std::size_t clusters = 0;
    VertexGraph edges;
    std::size_t surface_vertices = 0;  // of which V have rows
    std::size_t clusters_per_shard = 1;

    [[nodiscard]] std::size_t vertex_count() const { return planes.size(); }
    [[nodiscard]] std::size_t columns() const { return basis.coefficient_count(); }
    [[nodiscard]] std::span<const float> row(std::size_t vertex) const {
        return std::span(values).subspan(first[vertex] * columns(), planes[vertex] * columns());
    }
};

// By channel: what its values are multiplied by, so that errors weigh alike.
[[nodiscard]] std::vector<float> channel_scales(const transport::ColourModel& colour);

// Bakes them as relume-bake --receivers vertices does. Of the surface's runs of sixteen
// clusters side by side, at most so many that are spread evenly: other vertices are left out.
// Memory: four bytes a value. Throws as bake::bake does.
[[nodiscard]] VertexRows bake_vertex_rows(const scene::Scene& scene,
                                          const bake::BakeParameters& parameters,
                                          std::size_t most_runs);

}  // namespace relume::lab
