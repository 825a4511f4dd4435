// Rows of vertices in three bases over their clusters: what is stored, what it costs, what it
// is off by.
#include "tests/lab/cpca/coded_rows.h"

#include "tests/lab/cpca/seams.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace relume::lab {
namespace {

constexpr std::uint32_t kVertices = 30;
constexpr std::uint32_t kChannels = 2;

// Of two terms, near a subspace of three dimensions.
VertexRows made_up_rows(float noise = 0.01F) {
    VertexRows rows;
    rows.basis = basis::CubemapBasis::haar(4);
    rows.channels = kChannels;
    rows.planes.assign(kVertices, 2 * kChannels);
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    const auto row = static_cast<Eigen::Index>(2 * kChannels * rows.columns());
    const auto draw = [&] { return normal(random); };
    const RowVectors mix = RowVectors::NullaryExpr(kVertices, 3, draw);
    const RowVectors values = mix * RowVectors::NullaryExpr(3, row, draw) +
                              noise * RowVectors::NullaryExpr(kVertices, row, draw);
    rows.values.assign(values.data(), values.data() + values.size());
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        rows.first.push_back(rows.first.back() + 2 * kChannels);
    }
    return rows;
}

// A full cluster less two, one of a single vertex, one that is empty, one of a single vertex.
std::vector<std::vector<std::uint32_t>> made_up_clusters() {
    std::vector<std::vector<std::uint32_t>> clusters(4);
    for (std::uint32_t v = 2; v < kVertices; ++v) {
        clusters[0].push_back(v);
    }
    clusters[1] = {1};
    clusters[3] = {0};
    return clusters;
}

// Each coefficient lit alone: answers are the stored rows.
RowVectors every_coefficient(const VertexRows& rows) {
    const auto n = static_cast<Eigen::Index>(rows.columns());
    return RowVectors::Identity(n, n);
}

class CodedRowsIn : public testing::TestWithParam<ClusterBasis> {
  protected:
    VertexRows rows_ = made_up_rows();
    LightWeights weights_{rows_.basis};
    CodedRows coded_{
        rows_, made_up_clusters(), weights_, {.basis = GetParam(), .falloff = 0.25F}};
};

TEST_P(CodedRowsIn, AreTheRowsWhereStepsAreFine) {
    const std::vector<float> steps(rows_.columns(), 1e-6F);
    double energy = 0;
    double error = 0;
    for (const CodedCluster& cluster : coded_.clusters()) {
        const std::size_t members = cluster.members().size();
        // S is the size of the cluster, whatever it costs.
        const bool is_line = GetParam() == ClusterBasis::haar_line;
        const EncodedCluster encoded = cluster.encode(
            steps, is_line ? transport::kBlockSize : members, every_coefficient(rows_));
        const std::size_t values = cluster.planes() * rows_.columns();
        std::vector<float> column(encoded.answers.size() / values);
        for (std::size_t value = 0; value < values; ++value) {
            for (std::size_t i = 0; i < column.size(); ++i) {
                column[i] = encoded.answers[i * values + value];
            }
            cluster.vertices_from_components(column, encoded.components);
            for (std::size_t i = 0; i < members; ++i) {
                const float exact = rows_.row(cluster.members()[i])[value];
                energy += double{exact} * exact;
                error += (double{column[i]} - exact) * (double{column[i]} - exact);
            }
        }
    }
    // A learned basis is stored in 16 bits.
    EXPECT_LT(std::sqrt(error / energy), 1e-4);
}

TEST_P(CodedRowsIn, AreOffByWhatTheyState) {
    const std::vector<float> steps =
        steps_of_rule(rows_.basis, {.scale = 0.2F, .coarsest = 0.5F});
    const StoredRows stored = coded_.store(steps, every_coefficient(rows_));
    LightSums error;
    LightSums energy;
    for (std::size_t plane = 0; plane < rows_.first.back(); ++plane) {
        double constant = 0;
        double constant_error = 0;
        for (std::size_t j = 0; j < rows_.columns(); ++j) {
            const double exact = rows_.values[plane * rows_.columns() + j];
            const double off = stored.answers[plane * rows_.columns() + j] - exact;
            error.natural += weights_.variances[j] * off * off;
            energy.natural += weights_.variances[j] * exact * exact;
            error.sun += off * off;
            energy.sun += exact * exact;
            for (const auto& [coefficient, value] : weights_.constant) {
                constant += coefficient == j ? double{value} * exact : 0;
                constant_error += coefficient == j ? double{value} * off : 0;
            }
        }
        error.natural += constant_error * constant_error;
        energy.natural += constant * constant;
    }
    // Values of the tail of a block that no vertex has count too: they are a small part.
    const double slack = GetParam() == ClusterBasis::haar_line ? 0.6 : 0.01;
    const double natural = std::sqrt(error.natural / energy.natural);
    const double sun = std::sqrt(error.sun / energy.sun);
    EXPECT_GT(natural, 0.001);
    EXPECT_NEAR(stored.expected.natural, natural, slack * natural);
    EXPECT_NEAR(stored.expected.sun, sun, slack * sun);
}

TEST_P(CodedRowsIn, KeepToTheErrorAskedFor) {
    const LightErrors asked{.natural = 0.05, .sun = 0.03};
    const StepRule rule = coded_.rule_for(asked);
    const LightErrors error = coded_.error(steps_of_rule(rows_.basis, rule));
    EXPECT_LE(error.natural, asked.natural);
    EXPECT_LE(error.sun, asked.sun);
    EXPECT_GT(error.sun, 0.8 * asked.sun);
    // Finer steps cost more.
    const RowVectors none(static_cast<Eigen::Index>(rows_.columns()), 0);
    const StepRule finer = coded_.rule_for({.natural = 0.005, .sun = 0.003});
    EXPECT_GT(coded_.store(steps_of_rule(rows_.basis, finer), none).bytes.total(),
              coded_.store(steps_of_rule(rows_.basis, rule), none).bytes.total());
}

INSTANTIATE_TEST_SUITE_P(Bases,
                         CodedRowsIn,
                         testing::Values(ClusterBasis::identity,
                                         ClusterBasis::haar_line,
                                         ClusterBasis::learned));

TEST(CodedRows, OfALowRankNeedFewComponents) {
    const VertexRows rows = made_up_rows();
    const LightWeights weights(rows.basis);
    const CodedRows coded(rows, made_up_clusters(), weights,
                          {.basis = ClusterBasis::learned, .falloff = 0.25F});
    const StepRule rule = coded.rule_for({.natural = 0.05, .sun = 0.05});
    const RowVectors none(static_cast<Eigen::Index>(rows.columns()), 0);
    const StoredRows stored = coded.store(steps_of_rule(rows.basis, rule), none);
    EXPECT_EQ(stored.components, (std::vector<std::size_t>{3, 1, 1}));
    EXPECT_EQ(stored.bytes.bases, 3 * (2 * 28 + 4) + 2 * (2 * 1 + 4));
}

// What the stored coefficients make of the cluster's rows, against these.
double relative_error(const VertexRows& rows,
                      const CodedCluster& cluster,
                      const EncodedCluster& encoded) {
    const std::size_t values = cluster.planes() * rows.columns();
    std::vector<float> column(cluster.width());
    double energy = 0;
    double error = 0;
    for (std::size_t value = 0; value < values; ++value) {
        for (std::size_t i = 0; i < column.size(); ++i) {
            column[i] = encoded.answers[i * values + value];
        }
        cluster.vertices_from_components(column, encoded.components);
        for (std::size_t i = 0; i < cluster.members().size(); ++i) {
            const double exact = rows.row(cluster.members()[i])[value];
            energy += exact * exact;
            error += (column[i] - exact) * (column[i] - exact);
        }
    }
    return std::sqrt(error / energy);
}

TEST(CodedRows, OfAsManyComponentsAsTheRankAreTheRows) {
    const VertexRows rows = made_up_rows(0);
    const LightWeights weights(rows.basis);
    const CodedRows coded(rows, made_up_clusters(), weights,
                          {.basis = ClusterBasis::learned, .falloff = 0.25F});
    const std::vector<float> steps(rows.columns(), 1e-6F);
    const CodedCluster& cluster = coded.clusters()[0];
    const RowVectors lights = every_coefficient(rows);
    EXPECT_LT(relative_error(rows, cluster, cluster.encode(steps, 3, lights)), 1e-4);
    EXPECT_GT(relative_error(rows, cluster, cluster.encode(steps, 2, lights)), 0.1);
}

// S may be larger than a cluster: then it is the cluster's size.
TEST(CodedRows, OfMoreComponentsThanVerticesHaveAsManyAsVertices) {
    const VertexRows rows = made_up_rows();
    const LightWeights weights(rows.basis);
    for (const ClusterBasis basis : {ClusterBasis::learned, ClusterBasis::identity}) {
        const CodedRows coded(rows, made_up_clusters(), weights,
                              {.basis = basis, .falloff = 0.25F, .most_components = 1000});
        const std::vector<float> steps(rows.columns(), 1e-6F);
        for (const CodedCluster& cluster : coded.clusters()) {
            const std::size_t members = cluster.members().size();
            const RowVectors lights = every_coefficient(rows);
            const EncodedCluster more = cluster.encode(steps, 1000, lights);
            const EncodedCluster all = cluster.encode(steps, members, lights);
            EXPECT_EQ(more.components, members);
            EXPECT_EQ(more.answers, all.answers);
            EXPECT_EQ(more.basis_bytes, all.basis_bytes);
            EXPECT_LT(relative_error(rows, cluster, more), 1e-4);
            EXPECT_LE(cluster.components(steps, 1000), members);
        }
        const RowVectors none(static_cast<Eigen::Index>(rows.columns()), 0);
        EXPECT_EQ(coded.store(steps, none).components, (std::vector<std::size_t>{28, 1, 1}));
    }
}

TEST(ShardBytes, AreThoseOfAShard) {
    const VertexRows rows = made_up_rows();
    const LightWeights weights(rows.basis);
    const CodedRows coded(rows, made_up_clusters(), weights, {.basis = ClusterBasis::identity});
    const std::vector<float> steps(rows.columns(), 3.0F);
    const RowVectors none(static_cast<Eigen::Index>(rows.columns()), 0);
    std::vector<transport::EncodedBlock> blocks;
    for (const CodedCluster& cluster : coded.clusters()) {
        for (auto& block : cluster.encode(steps, cluster.members().size(), none).blocks) {
            blocks.push_back(std::move(block));
        }
    }
    const test::ScratchDirectory directory;
    const transport::ShardHeader header = transport::write_shard(
        directory.path() / "shard",
        {.columns = static_cast<std::uint32_t>(rows.columns()), .channels = kChannels}, blocks);
    EXPECT_EQ(shard_bytes(blocks).total(), header.index_bytes + header.data_bytes);
}

TEST(Seams, AreWhatBordersAddBeyondOtherEdges) {
    VertexRows rows = made_up_rows();
    // A line of vertices, one light.
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        for (const std::uint32_t u : {v - 1, v + 1}) {
            if (u < kVertices) {
                rows.edges.neighbours.push_back(u);
            }
        }
        rows.edges.first.push_back(static_cast<std::uint32_t>(rows.edges.neighbours.size()));
    }
    std::vector<std::uint32_t> cluster_of(kVertices, 0);
    std::fill(cluster_of.begin() + 15, cluster_of.end(), 1);
    std::vector<float> exact(rows.first.back());
    std::vector<float> coded(rows.first.back());
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        for (std::size_t i = rows.first[v]; i < rows.first[v + 1]; ++i) {
            exact[i] = static_cast<float>(v);  // jumps of one everywhere
            // An error that changes by ±0.1 at edges, and by 0.3 more at the border.
            coded[i] = exact[i] + (v % 2 == 0 ? 0.05F : -0.05F) + (v >= 15 ? -0.3F : 0.0F);
        }
    }
    const SeamFigures figures = measure_seams(rows, cluster_of, exact, coded, 1, 0, 1);
    EXPECT_EQ(figures.border_edges, 1U);
    EXPECT_EQ(figures.inner_edges, 28U);
    EXPECT_NEAR(figures.added, 0.4 / 0.1, 1e-3);
    EXPECT_NEAR(figures.shown, 0.6 / std::sqrt(1 + 0.01), 1e-3);
    EXPECT_EQ(measure_seams(rows, cluster_of, exact, exact, 1, 0, 1).added, 1);
}

}  // namespace
}  // namespace relume::lab
