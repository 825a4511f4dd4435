// Clusters are of one material, full, compact, and halved at every power of two.
#include "precompute/bake/receivers/vertex/cluster_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace relume::bake {
namespace {

struct Cloud {
    std::vector<Imath::V3f> positions;
    std::vector<Imath::V3f> normals;
    std::vector<std::uint32_t> materials;
    std::vector<std::vector<float>> rows;

    [[nodiscard]] ClusterOrder order() const {
        const std::vector<std::span<const float>> spans(rows.begin(), rows.end());
        return cluster_order({positions, normals, materials, spans});
    }
};

// On the surface of a box of 4×2×1, of `materials` by turns.
Cloud cloud(std::size_t count, std::uint32_t materials) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    Cloud cloud;
    for (std::size_t i = 0; i < count; ++i) {
        Imath::V3f position(unit(random), unit(random), unit(random));
        Imath::V3f normal(0, 0, 0);
        const int axis = static_cast<int>(i % 3);
        normal[axis] = position[axis] = unit(random) < 0 ? -1.0F : 1.0F;
        cloud.positions.push_back(position * Imath::V3f(2, 1, 0.5F));
        cloud.normals.push_back(normal);
        cloud.materials.push_back(static_cast<std::uint32_t>(i * materials / count));
        // Light from above and a shadow from one side.
        cloud.rows.push_back({1 + normal.y, 0.3F * position.x, position.z > 0 ? 1.0F : 0.0F});
    }
    return cloud;
}

TEST(ClusterOrder, ClustersHoldEveryVertexOnce) {
    const Cloud some = cloud(3000, 3);
    const ClusterOrder order = some.order();
    std::vector<std::uint32_t> sorted = order.old_from_new;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) {
        ASSERT_EQ(sorted[i], i);
    }
    std::uint32_t next = 0;
    for (const VertexCluster& cluster : order.clusters) {
        EXPECT_EQ(cluster.first, next);
        next += cluster.count;
        for (std::uint32_t i = cluster.first; i < next; ++i) {
            EXPECT_EQ(some.materials[order.old_from_new[i]], cluster.material);
        }
    }
    EXPECT_EQ(next, 3000U);
    EXPECT_LE(order.clusters.size(), 2U * 3 * 4);  // of 1000 = 3·256 + 232
}

// The mean difference of rows of neighbours in the order is far below that of any two.
TEST(ClusterOrder, NeighboursInOrderAnswerAlike) {
    const Cloud some = cloud(4096, 1);
    const ClusterOrder order = some.order();
    const auto mean_difference = [&](std::size_t apart) {
        double sum = 0;
        for (std::size_t i = 0; i + apart < order.old_from_new.size(); ++i) {
            const auto& a = some.rows[order.old_from_new[i]];
            const auto& b = some.rows[order.old_from_new[i + apart]];
            sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        }
        return sum / static_cast<double>(order.old_from_new.size() - apart);
    };
    EXPECT_LT(mean_difference(1), 0.06 * mean_difference(2048));
    EXPECT_LT(mean_difference(16), 0.2 * mean_difference(2048));
}

TEST(ClusterOrder, EqualRowsAreOrderedInSpace) {
    Cloud some = cloud(4096, 1);
    std::fill(some.rows.begin(), some.rows.end(), std::vector<float>{1, 2});
    const ClusterOrder order = some.order();
    const auto mean_distance = [&](std::size_t apart) {
        double sum = 0;
        for (std::size_t i = 0; i + apart < order.old_from_new.size(); ++i) {
            const auto& a = some.positions[order.old_from_new[i]];
            const auto& b = some.positions[order.old_from_new[i + apart]];
            sum += (a - b).length();
        }
        return sum / static_cast<double>(order.old_from_new.size() - apart);
    };
    EXPECT_LT(mean_distance(1), 0.15 * mean_distance(2048));
    EXPECT_LT(mean_distance(16), 0.35 * mean_distance(2048));
}

TEST(ClusterOrder, ClustersLookOneWay) {
    const Cloud some = cloud(4096, 1);
    const ClusterOrder order = some.order();
    std::size_t mixed = 0;
    for (const VertexCluster& cluster : order.clusters) {
        const Imath::V3f& first = some.normals[order.old_from_new[cluster.first]];
        bool is_mixed = false;
        for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
            is_mixed |= some.normals[order.old_from_new[i]].dot(first) < 0.99F;
        }
        mixed += is_mixed ? 1 : 0;
    }
    EXPECT_LE(mixed, order.clusters.size() / 8);
    EXPECT_LE(order.clusters.size(), 6U * 4);  // six faces of 683
}

TEST(ClusterOrder, AFewVerticesAndEqualOnesAreOrdered) {
    Cloud one = cloud(1, 1);
    EXPECT_EQ(one.order().clusters, (std::vector<VertexCluster>{{0, 1, 0}}));
    Cloud same = cloud(700, 1);
    std::fill(same.positions.begin(), same.positions.end(), Imath::V3f(1, 1, 1));
    std::fill(same.normals.begin(), same.normals.end(), Imath::V3f(0, 1, 0));
    EXPECT_EQ(same.order().clusters.size(), 3U);
}

}  // namespace
}  // namespace relume::bake
