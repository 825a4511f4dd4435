// The order in which vertices are stored: clusters of one material, close together and looking
// the same way, and within a cluster so that neighbouring slots are neighbours on the surface.
#pragma once

#include "precompute/bake/receivers/vertex/refined_surface.h"

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
};

struct ClusterOrder {
    std::vector<std::uint32_t> old_from_new;
    std::vector<VertexCluster> clusters;  // by ascending material
};

// Each material's vertices are cut in two again and again across the widest of six extents: of
// positions, and of normals times the length that `normal_weight` times the extent of the
// material's vertices is. A cut goes through a wide gap, as between the faces of a box or two
// posts, where there is one with at least 256 vertices on each side, else through the middle
// after full clusters. Clusters are halved at 2^k slots down to single vertices.
inline constexpr float kNormalWeight = 0.5F;
[[nodiscard]] ClusterOrder cluster_order(const VertexTable& vertices,
                                         float normal_weight = kNormalWeight);

}  // namespace relume::bake
