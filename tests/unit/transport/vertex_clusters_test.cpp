#include "protocol/transport/vertex_clusters.h"

#include "protocol/transport/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace relume::transport {
namespace {

TEST(VertexClusters, NumberVerticesAndBlocksFromClusterToCluster) {
    const VertexClusters clusters({{.vertices = 256, .terms = 1},
                                   {.vertices = 3, .terms = 4},
                                   {.vertices = 1, .terms = 2}});
    EXPECT_EQ(clusters.vertex_count(), 260U);
    EXPECT_EQ(clusters.block_count(), 7U);
    EXPECT_EQ(clusters.place_of_vertex(0), (VertexPlace{.block = 0, .slot = 0, .terms = 1}));
    EXPECT_EQ(clusters.place_of_vertex(255),
              (VertexPlace{.block = 0, .slot = 255, .terms = 1}));
    EXPECT_EQ(clusters.place_of_vertex(256), (VertexPlace{.block = 1, .slot = 0, .terms = 4}));
    EXPECT_EQ(clusters.place_of_vertex(258), (VertexPlace{.block = 1, .slot = 2, .terms = 4}));
    EXPECT_EQ(clusters.place_of_vertex(259), (VertexPlace{.block = 5, .slot = 0, .terms = 2}));
    for (std::uint32_t block = 0; block < clusters.block_count(); ++block) {
        EXPECT_EQ(clusters.cluster_of_block(block), block < 1 ? 0U : block < 5 ? 1U : 2U);
    }
}

TEST(VertexClusters, RefuseWhatNoBlockHolds) {
    EXPECT_THROW(VertexClusters({{.vertices = 0, .terms = 1}}), TransportError);
    EXPECT_THROW(VertexClusters({{.vertices = 257, .terms = 1}}), TransportError);
    EXPECT_THROW(VertexClusters({{.vertices = 1, .terms = 0}}), TransportError);
    EXPECT_THROW(VertexClusters({{.vertices = 1, .terms = kMaxTerms + 1}}), TransportError);
}

}  // namespace
}  // namespace relume::transport
