#include "protocol/tripling/direction_grid.h"

#include "protocol/basis/cubemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>

namespace relume::tripling {
namespace {

Imath::V3f random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Imath::V3f(normal(random), normal(random), normal(random)).normalized();
}

// Nodes by direction, so that those on edges are one.
std::tuple<int, int, int> place(const Imath::V3f& d) {
    const auto rounded = [](float x) { return static_cast<int>(std::lround(1e4F * x)); };
    return {rounded(d.x), rounded(d.y), rounded(d.z)};
}

std::map<std::tuple<int, int, int>, float> weights_by_direction(const DirectionGrid& grid,
                                                                const Imath::V3f& direction) {
    std::map<std::tuple<int, int, int>, float> weights;
    for (const auto& node : grid.nodes_near(direction)) {
        weights[place(grid.direction(node.index))] += node.weight;
    }
    return weights;
}

TEST(DirectionGrid, WeighsTheNodesAroundADirection) {
    std::mt19937 random(1);
    for (const std::uint32_t side : {1U, 2U, 3U, 8U, 33U}) {
        const DirectionGrid grid(side);
        for (int i = 0; i < 200; ++i) {
            const Imath::V3f direction = random_direction(random);
            float sum = 0;
            for (const auto& node : grid.nodes_near(direction)) {
                EXPECT_GE(node.weight, 0);
                EXPECT_LT(node.index, grid.node_count());
                sum += node.weight;
                if (node.weight > 0 && side > 1) {
                    // Not further than the diagonal of a cell.
                    EXPECT_GT(grid.direction(node.index).dot(direction),
                              std::cos(2.3F / static_cast<float>(side - 1)) - 1e-5F);
                }
            }
            EXPECT_NEAR(sum, 1, 1e-6);
        }
    }
    EXPECT_THROW(DirectionGrid(0), std::invalid_argument);
    EXPECT_THROW(DirectionGrid(66), std::invalid_argument);
}

TEST(DirectionGrid, IsExactAtItsNodes) {
    const DirectionGrid grid(6);
    for (std::size_t node = 0; node < grid.node_count(); ++node) {
        const auto weights = weights_by_direction(grid, grid.direction(node));
        const auto found = weights.find(place(grid.direction(node)));
        ASSERT_NE(found, weights.end());
        EXPECT_NEAR(found->second, 1, 1e-4);
    }
}

// Two directions on either side of an edge get nearly the same weights at the same nodes.
TEST(DirectionGrid, IsContinuousAcrossEdgesOfFaces) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> along(-0.999F, 0.999F);
    const DirectionGrid grid(5);
    for (int i = 0; i < 300; ++i) {
        const float v = along(random);
        const int axis = i % 3;
        Imath::V3f before;
        Imath::V3f after;
        before[axis] = after[(axis + 1) % 3] = i % 2 == 0 ? 1 : -1;
        before[(axis + 1) % 3] = (i % 2 == 0 ? 1.0F : -1.0F) * 0.99999F;
        after[axis] = before[(axis + 1) % 3];
        before[(axis + 2) % 3] = after[(axis + 2) % 3] = v;
        ASSERT_NE(basis::face_point_from_direction(before).face,
                  basis::face_point_from_direction(after).face);
        const auto a = weights_by_direction(grid, before);
        auto b = weights_by_direction(grid, after);
        for (const auto& [node, weight] : a) {
            EXPECT_NEAR(weight, b[node], 1e-3);
        }
    }
}

}  // namespace
}  // namespace relume::tripling
