// The order in which vertices are stored: clusters of one material that answer to light alike,
// and within a cluster so that vertices in neighbouring slots do.
#pragma once

#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/bake/receivers/vertex/row_axis.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Of the vertices to be ordered, by their old numbers.
struct VertexTable {
    std::span<const Imath::V3f> positions;
    std::span<const Imath::V3f> normals;
    std::span<const std::uint32_t> materials;
    Rows rows;  // how they answer to light (surface_probe.h)
};

struct ClusterOrder {
    std::vector<std::uint32_t> old_from_new;
    std::vector<VertexCluster> clusters;  // by ascending material
};

// Each material's vertices are cut in two again and again, across the widest of six extents: of
// positions, and of normals times the extent of the material's vertices. A cut goes through a
// wide gap, as between the faces of a box or two posts, where there is one with at least a
// cluster on each side, else through the middle after full clusters. Groups of at most four
// clusters, which lie close to each other so that a view can pass by them together, are then
// cut into clusters, and down to single vertices at 2^k slots, where their rows differ most.
[[nodiscard]] ClusterOrder cluster_order(const VertexTable& vertices);

}  // namespace relume::bake
