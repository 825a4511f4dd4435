// Subspaces of clusters, and vertices that move between them.
#include "tests/lab/cpca/reassignment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>
#include <random>

namespace relume::lab {
namespace {

constexpr std::size_t kNumbers = 40;

RowVectors random_vectors(Eigen::Index count, Eigen::Index rank, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    const auto draw = [&] { return normal(random); };
    const RowVectors mix = RowVectors::NullaryExpr(count, rank, draw);
    return mix * RowVectors::NullaryExpr(rank, kNumbers, draw);
}

std::vector<std::uint32_t> all(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

// Each vertex has the next ones for neighbours.
VertexGraph line_of(std::uint32_t count) {
    VertexGraph graph;
    for (std::uint32_t v = 0; v < count; ++v) {
        if (v > 0) {
            graph.neighbours.push_back(v - 1);
        }
        if (v + 1 < count) {
            graph.neighbours.push_back(v + 1);
        }
        graph.first.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
    }
    return graph;
}

TEST(Subspace, OfAsManyAxesAsTheRankMissesNothing) {
    const RowVectors vectors = random_vectors(30, 5, 1);
    const double energy = vectors.squaredNorm();
    EXPECT_LT(principal_subspace(vectors, all(30), 5).missed, 1e-6 * energy);
    EXPECT_GT(principal_subspace(vectors, all(30), 4).missed, 1e-3 * energy);
}

TEST(Subspace, HasOrthonormalAxesAndNoMoreThanMembers) {
    const RowVectors vectors = random_vectors(30, 20, 2);
    const Subspace subspace = principal_subspace(vectors, all(7), 25);
    ASSERT_EQ(subspace.axes.rows(), 7);
    const Eigen::MatrixXf products = subspace.axes * subspace.axes.transpose();
    EXPECT_LT((products - Eigen::MatrixXf::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-5F);
    EXPECT_EQ(principal_subspace(vectors, {}, 25).axes.rows(), 0);
    // Of equal vectors one axis is all.
    const RowVectors equal = vectors.row(0).replicate(6, 1);
    EXPECT_EQ(principal_subspace(equal, all(6), 4).axes.rows(), 1);
}

TEST(Subspace, IsTheBestOne) {
    const RowVectors vectors = random_vectors(20, 20, 3);
    const double missed = principal_subspace(vectors, all(20), 3).missed;
    for (unsigned seed = 0; seed < 20; ++seed) {
        // Axes that span some other three of the vectors.
        std::vector<std::uint32_t> some{seed % 20, (seed * 7 + 3) % 20, (seed * 3 + 11) % 20};
        const Subspace other = principal_subspace(vectors, some, 3);
        double sum = 0;
        for (Eigen::Index i = 0; i < 20; ++i) {
            sum += other.squared_distance(vectors.row(i));
        }
        EXPECT_GE(sum, missed * (1 - 1e-6));
    }
}

TEST(Reassign, NeverRaisesTheErrorNorPassesTheCapacity) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const RowVectors vectors = random_vectors(60, 30, 10 + seed);
        std::vector<std::uint32_t> cluster_of;
        for (std::uint32_t v = 0; v < 60; ++v) {
            cluster_of.push_back(v / 20);
        }
        const Reassignment found = reassign(vectors, line_of(60), cluster_of, 3,
                                            {.capacity = 20 + seed % 3, .axes = 4});
        for (std::size_t i = 1; i < found.errors.size(); ++i) {
            EXPECT_LE(found.errors[i], found.errors[i - 1]);
        }
        EXPECT_LT(found.errors.back(), found.errors.front());
        std::size_t count = 0;
        for (const auto& members : members_of(found.cluster_of, 3)) {
            EXPECT_LE(members.size(), 20 + seed % 3);
            count += members.size();
        }
        EXPECT_EQ(count, 60U);
        // What it says is what there is.
        double error = 0;
        for (const auto& members : members_of(found.cluster_of, 3)) {
            error += principal_subspace(vectors, members, 4).missed;
        }
        EXPECT_NEAR(found.errors.back(), error, 1e-4 * error);
    }
}

TEST(Reassign, FindsSubspacesThatVerticesWereDrawnFrom) {
    RowVectors vectors(40, kNumbers);
    vectors.topRows(20) = random_vectors(20, 2, 4);
    vectors.bottomRows(20) = random_vectors(20, 2, 5);
    std::vector<std::uint32_t> cluster_of(40, 0);
    std::fill(cluster_of.begin() + 20, cluster_of.end(), 1);
    for (const std::uint32_t v : {3U, 8U, 12U}) {  // each full cluster holds three of the other
        std::swap(cluster_of[v], cluster_of[v + 20]);
    }
    const Reassignment found =
        reassign(vectors, line_of(40), cluster_of, 2, {.capacity = 20, .axes = 2});
    EXPECT_LT(found.errors.back(), 1e-6 * found.errors.front());
    for (std::uint32_t v = 0; v < 40; ++v) {
        EXPECT_EQ(found.cluster_of[v], found.cluster_of[v / 20 * 20]);
    }
}

TEST(Reassign, TakesEmptyAndTinyClusters) {
    const RowVectors vectors = random_vectors(5, 5, 6);
    const std::vector<std::uint32_t> cluster_of{0, 0, 0, 2, 2};  // 1 and 3 are empty
    const Reassignment found = reassign(vectors, line_of(5), cluster_of, 4, {.axes = 50});
    EXPECT_EQ(found.cluster_of.size(), 5U);
    EXPECT_LT(found.errors.back(), 1e-6 * vectors.squaredNorm());
    const Reassignment none = reassign(RowVectors(0, kNumbers), VertexGraph{}, {}, 2, {});
    EXPECT_TRUE(none.cluster_of.empty());
    EXPECT_EQ(none.errors.back(), 0);
}

TEST(Reassign, IsTheSameOnAnyNumberOfThreads) {
    const RowVectors vectors = random_vectors(90, 30, 7);
    std::vector<std::uint32_t> cluster_of;
    for (std::uint32_t v = 0; v < 90; ++v) {
        cluster_of.push_back(v % 6);
    }
    const ReassignmentOptions options{.capacity = 16, .axes = 3};
    const Reassignment many = reassign(vectors, line_of(90), cluster_of, 6, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Reassignment alone = reassign(vectors, line_of(90), cluster_of, 6, options);
    EXPECT_EQ(many.cluster_of, alone.cluster_of);
    EXPECT_EQ(many.errors, alone.errors);
}

}  // namespace
}  // namespace relume::lab
