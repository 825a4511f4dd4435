// Methods over a surface: its first terms, and clustered PCA.
#include "tests/lab/cpca/transport_rows.h"
#include "tests/lab/geometry/leading_terms.h"
#include "tests/lab/measures/experiment.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_mesh.h"
#include "tests/support/tiny_transport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>

namespace relume::lab {
namespace {

using transport::kBlockSize;
using transport::kColours;

// The tiny mesh: six walls of 64 vertices, of one to five terms, and a box.
class SurfaceMethods : public testing::Test {
  protected:
    SurfaceMethods() {
        test::write_tiny_mesh_transport(scratch_.path() / "mesh.relume");
        scene_.haar = std::make_shared<const served::Scene>(
            transport::Transport::open(scratch_.path() / "mesh.relume"));
        experiment_.scene = scene_;
        experiment_.sequence = load_sequence("turn-and-orbit");
        experiment_.sequence.images = 8;
        experiment_.environments.environment =
            load_environment("sky-sunset", scene_.haar->face_resolution());
    }

    [[nodiscard]] const transport::Transport& transport() const {
        return scene_.haar->transport();
    }
    [[nodiscard]] std::vector<Record> records_of_method(const std::string& text) {
        experiment_.methods = {method_from_text(text)};
        return run_experiment(experiment_).records;
    }
    [[nodiscard]] std::vector<float> some_light() const {
        std::mt19937 random(3);
        std::normal_distribution<float> normal;
        std::vector<float> light(kColours * transport().column_count());
        std::generate(light.begin(), light.end(), [&] { return normal(random); });
        return light;
    }

    test::ScratchDirectory scratch_;
    LabScene scene_;
    Experiment experiment_;
};

TEST_F(SurfaceMethods, AllTermsAndAllCoefficientsAreTheExactImageOfEveryView) {
    for (const char* text : {"full-product", "factored-k5-100000", "guarded-100000"}) {
        for (const Record& record : records_of_method(text)) {
            EXPECT_LT(record.error.l2, 1e-5) << record.method << " " << record.image;
        }
    }
}

TEST_F(SurfaceMethods, FewerTermsLeaveMoreAndReadLess) {
    experiment_.sequence.images = 4;
    experiment_.sequence.orbit_degrees =
        Curve(Curve::Keys{.keys = {{0, 0}, {4, 360}}, .way = Curve::Way::linear});
    double error = 0;
    std::uint64_t bytes = ~std::uint64_t{0};
    for (const char* text :
         {"factored-k5-100000", "factored-k3-100000", "factored-k1-100000"}) {
        const std::vector<Record> records = records_of_method(text);
        const auto worst = std::max_element(
            records.begin(), records.end(),
            [](const Record& a, const Record& b) { return a.error.l2 < b.error.l2; });
        EXPECT_GT(worst->error.l2, error == 0 ? 0 : 0.01 + error) << text;
        EXPECT_LT(records.front().bytes, bytes) << text;
        error = worst->error.l2;
        bytes = records.front().bytes;
    }
}

TEST_F(SurfaceMethods, LeadingTermsHaveTheBlocksOfTheWhole) {
    const std::vector<float> light = some_light();
    const std::vector<double> whole = test::dense_product(transport(), light);
    const auto fewer = scene_.derived->leading_terms(*scene_.haar, 2);
    const std::vector<double> found = test::dense_product(fewer->transport(), light);
    const transport::VertexClusters& of_whole = transport().manifest().layout.clusters();
    const transport::VertexClusters& of_fewer = fewer->transport().manifest().layout.clusters();
    ASSERT_EQ(of_fewer.clusters().size(), of_whole.clusters().size());
    constexpr std::size_t kBlock = kColours * kBlockSize;
    for (std::size_t c = 0; c < of_whole.clusters().size(); ++c) {
        const std::uint32_t terms = of_fewer.clusters()[c].terms;
        EXPECT_EQ(terms, std::min(2U, of_whole.clusters()[c].terms));
        for (std::size_t i = 0; i < terms * kBlock; ++i) {
            ASSERT_EQ(found[of_fewer.first_block(c) * kBlock + i],
                      whole[of_whole.first_block(c) * kBlock + i]);
        }
    }
}

// What vertices see is of no term.
TEST_F(SurfaceMethods, LeadingTermsOfASurfaceThatSeesLightHaveNoVisibility) {
    test::write_tiny_mesh_transport(scratch_.path() / "seeing.relume", 1, 4);
    const auto seeing = transport::Transport::open(scratch_.path() / "seeing.relume");
    ASSERT_TRUE(seeing->visibility());
    const auto fewer = leading_terms(*seeing, 2);
    EXPECT_FALSE(fewer->visibility());
    EXPECT_LT(fewer->manifest().block_count(), seeing->manifest().block_count());
}

TEST_F(SurfaceMethods, RowsOfATransportAreItsProductOfEveryLight) {
    const VertexRows rows = rows_of_transport(transport());
    const std::vector<float> light = some_light();
    std::vector<double> sums = test::dense_product(transport(), light);
    const transport::Manifest& manifest = transport().manifest();
    const transport::VertexClusters& clusters = manifest.layout.clusters();
    ASSERT_EQ(rows.vertex_count(), clusters.vertex_count());
    for (std::size_t first = 0; first < sums.size(); first += kBlockSize) {
        std::array<float, kBlockSize> block{};
        std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(first), kBlockSize,
                    block.begin());
        transport::block_receivers_from_coefficients(manifest.block_basis, block);
        std::copy(block.begin(), block.end(),
                  sums.begin() + static_cast<std::ptrdiff_t>(first));
    }
    const std::vector<float> scales = channel_scales(manifest.colour);
    for (std::uint32_t v = 0; v < rows.vertex_count(); ++v) {
        const auto place = clusters.place_of_vertex(v);
        for (std::uint32_t term = 0; term < place.terms; ++term) {
            // One channel: its row times the red light.
            const std::span<const float> row =
                rows.row(v).subspan(std::size_t{term} * rows.columns(), rows.columns());
            const double product =
                std::inner_product(row.begin(), row.end(), light.begin(), 0.0) / scales[0];
            const double expected =
                sums[(std::size_t{place.block} + term) * kColours * kBlockSize + place.slot];
            ASSERT_NEAR(product, expected, 1e-3 * (1 + std::abs(expected))) << v;
        }
    }
}

TEST_F(SurfaceMethods, WithAsManyBasesAsVerticesClusteredPcaIsTheTransport) {
    experiment_.sequence = load_sequence("quick-turn");
    experiment_.sequence.images = 50;  // ten of rest, in which the second step catches up
    const std::vector<Record> records = records_of_method("cpca-c12-s256-100000");
    // What is left is quantised anew, with the transport's own steps.
    EXPECT_LT(records.back().error.l2, 0.02);
    EXPECT_GT(records[20].error.l2, records.back().error.l2);
}

TEST_F(SurfaceMethods, FewerBasesLeaveMoreAndReadLess) {
    experiment_.sequence = load_sequence("quick-turn");
    const auto at_rest = [&](const char* text) { return records_of_method(text).back(); };
    const Record many = at_rest("cpca-c12-s64-100000");
    const Record few = at_rest("cpca-c12-s8-100000");
    EXPECT_GT(few.error.l2, 1.5 * many.error.l2);
    EXPECT_LT(records_of_method("cpca-c12-s8-100000").front().bytes,
              records_of_method("cpca-c12-s64-100000").front().bytes);
}

TEST_F(SurfaceMethods, EveryVertexIsInOneCluster) {
    const auto clustered =
        scene_.derived->clustered(*scene_.haar, {.clusters = 12, .bases = 9});
    std::set<std::uint32_t> seen;
    std::uint32_t block = 0;
    for (const ClusteredTransport::Cluster& cluster : clustered->clusters) {
        EXPECT_LE(cluster.members.size(), kBlockSize);
        EXPECT_EQ(cluster.first_block, block);
        block += cluster.terms;
        for (const std::uint32_t vertex : cluster.members) {
            EXPECT_TRUE(seen.insert(vertex).second) << vertex;
            EXPECT_EQ(transport().manifest().layout.clusters().place_of_vertex(vertex).terms,
                      cluster.terms);
        }
        const auto bases = cluster.weights.cols();
        EXPECT_EQ(bases, std::min<std::ptrdiff_t>(
                             9, static_cast<std::ptrdiff_t>(cluster.members.size())));
        EXPECT_LT((cluster.weights.transpose() * cluster.weights -
                   Eigen::MatrixXf::Identity(bases, bases))
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-3F);
    }
    EXPECT_EQ(seen.size(), transport().manifest().layout.clusters().vertex_count());
}

TEST(HalvedClusters, SplitsTheLargestUntilThereAreSoMany) {
    const std::vector<std::uint32_t> cluster_of{0, 0, 0, 0, 0, 1, 1};
    EXPECT_EQ(halved_clusters(cluster_of, 2), cluster_of);
    EXPECT_EQ(halved_clusters(cluster_of, 4),
              (std::vector<std::uint32_t>{0, 0, 3, 2, 2, 1, 1}));
    EXPECT_EQ(halved_clusters(cluster_of, 7).size(), 7U);
    EXPECT_THROW((void)halved_clusters(cluster_of, 1), std::invalid_argument);
    EXPECT_THROW((void)halved_clusters(cluster_of, 8), std::invalid_argument);
}

TEST_F(SurfaceMethods, WhatIsNoSurfaceIsRefused) {
    test::write_tiny_transport(scratch_.path() / "image.relume");
    experiment_.scene = {.haar = std::make_shared<const served::Scene>(
                             transport::Transport::open(scratch_.path() / "image.relume")),
                         .sh_transport = {}};
    // Its camera does not move.
    EXPECT_THROW((void)records_of_method("nwa-20"), std::invalid_argument);
    experiment_.sequence = load_sequence("quick-turn");
    experiment_.sequence.images = 1;
    EXPECT_EQ(records_of_method("nwa-20").size(), 1U);
    for (const char* text : {"factored-k2-30", "cpca-c12-s9-30"}) {
        EXPECT_THROW((void)records_of_method(text), std::runtime_error) << text;
    }
}

}  // namespace
}  // namespace relume::lab
