// A bake of a surface whose vertices' visibility is stored.
#include "precompute/bake/bake.h"
#include "precompute/bake/base/error.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/relight.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/program/usage.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/bake/file_bytes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

class VertexFieldBake : public testing::Test {
  protected:
    [[nodiscard]] std::shared_ptr<const transport::Transport> baked(
        const char* name, const FieldRequest& fields, const BakeHooks& hooks = {}) const {
        bake(scene_, parameters_, path(name), hooks, {}, fields);
        return transport::Transport::open(path(name));
    }
    [[nodiscard]] fs::path path(const char* name) const { return scratch_.path() / name; }

    scene::Scene scene_ = scene::build_builtin_scene("box");
    BakeParameters parameters_{.receivers = ReceiverKind::vertices,
                               .width = 32,
                               .height = 32,
                               .face_resolution = 8,
                               .bounces = 0,
                               .samples = 4,
                               .pixel_samples = 4,
                               .vertices = 600,
                               .terms = 1};
    test::ScratchDirectory scratch_;
};

TEST_F(VertexFieldBake, HasABlockForEachClusterAndAPointForEachVertex) {
    std::vector<std::string> notes;
    const auto transport =
        baked("v.relume", {.of_vertices = true},
              {.on_note = [&](const std::string& said) { notes.push_back(said); }});
    EXPECT_TRUE(find_faults(path("v.relume")).empty());
    ASSERT_TRUE(transport->visibility());
    EXPECT_EQ(transport->visibility()->face_resolution(), 8U);
    const auto& clusters = transport->manifest().layout.clusters();
    ASSERT_EQ(transport->visibility()->block_count(), clusters.clusters().size());
    for (std::uint32_t i = 0; i < clusters.clusters().size(); ++i) {
        EXPECT_EQ(transport->visibility()->point_count(i), clusters.clusters()[i].vertices);
    }
    EXPECT_FALSE(transport->manifest().materials);
    EXPECT_FALSE(fs::exists(path("v.relume") / "points.bin"));
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_NE(notes[1].find(std::to_string(clusters.vertex_count()) + " points, 6×8×8"),
              std::string::npos)
        << notes[1];
    const std::string text = text_from_description(describe(path("v.relume")));
    EXPECT_NE(text.find("visibility of"), std::string::npos) << text;
    EXPECT_NE(text.find("% open"), std::string::npos) << text;
    const auto without = baked("w.relume", {});
    EXPECT_FALSE(without->visibility());
    for (const char* file : {"mesh.bin", "brdfs.bin", "columns.bin", "receivers.bin"}) {
        EXPECT_TRUE(bytes_of(path("v.relume") / file) == bytes_of(path("w.relume") / file))
            << file;
    }
}

// Walls are diffuse: what a row of direct light answers is the irradiance by the bits, times
// one number for each material.
TEST_F(VertexFieldBake, BitsAndRowsAgreeOnDirectLight) {
    const auto transport = baked("v.relume", {.of_vertices = true, .resolution = 16});
    CubemapLight light;
    const LightTexels texels(16, 0);
    std::vector<float> fine(texels.size());
    const auto radiance = [](const Imath::V3f& direction) {
        return direction.normalized().dot({0.3F, 0.6F, 0.7F}) > 0.4F ? 2.0F : 0.3F;
    };
    for (auto& plane : light) {
        plane.resize(basis::texel_count(8));
    }
    for (std::size_t texel = 0; texel < light[0].size(); ++texel) {
        const float value =
            radiance(basis::direction_from_texel(8, basis::texel_from_index(8, texel)));
        for (auto& plane : light) {
            plane[texel] = value;
        }
    }
    // The same light in finer texels.
    for (std::size_t texel = 0; texel < fine.size(); ++texel) {
        const Imath::V3f direction =
            basis::direction_from_texel(16, basis::texel_from_index(16, texel));
        fine[texel] =
            light[0][basis::index_from_texel(8, basis::texel_from_direction(8, direction))];
    }
    const std::vector<double> rows = relit_receivers(*transport, light);
    const transport::Manifest& manifest = transport->manifest();
    const auto& clusters = manifest.layout.clusters();
    const auto& normals = transport->surface()->mesh.normals;
    const std::size_t words = transport->visibility()->words_per_point();
    std::vector<std::uint64_t> bits;
    std::map<std::uint32_t, std::vector<std::pair<double, double>>> by_material;
    std::size_t vertex = 0;
    for (std::uint32_t i = 0; i < clusters.clusters().size(); ++i) {
        transport->visibility()->read(i, bits);
        ASSERT_EQ(clusters.clusters()[i].terms, 1U);
        for (std::uint32_t slot = 0; slot < clusters.clusters()[i].vertices; ++slot) {
            const auto own = std::span(bits).subspan(slot * words, words);
            double irradiance = 0;
            for (std::size_t place = 0; place < texels.size(); ++place) {
                const std::size_t texel = texels.texel_index(place);
                const Imath::V3f direction(texels.direction_x()[place],
                                           texels.direction_y()[place],
                                           texels.direction_z()[place]);
                if (transport::is_open(own, texel)) {
                    irradiance += double{fine[texel]} * double{texels.irradiance()[place]} *
                                  std::max(0.0, double{direction.dot(normals[vertex])});
                }
            }
            by_material[clusters.clusters()[i].material].emplace_back(
                irradiance, rows[(std::size_t{i} * 3 + 1) * transport::kBlockSize + slot]);
            ++vertex;
        }
    }
    EXPECT_EQ(vertex, normals.size());
    for (const auto& [material, pairs] : by_material) {
        double cross = 0;
        double square = 0;
        for (const auto& [a, b] : pairs) {
            cross += a * b;
            square += a * a;
        }
        const double scale = cross / square;
        double off = 0;
        double norm = 0;
        for (const auto& [a, b] : pairs) {
            off += std::pow(b - scale * a, 2);
            norm += b * b;
        }
        std::printf("  material %u: %zu vertices, relative L2 to rows %.4f\n", material,
                    pairs.size(), std::sqrt(off / norm));
        EXPECT_GT(scale, 0);
        EXPECT_LT(std::sqrt(off / norm), 0.1) << material;
    }
}

TEST_F(VertexFieldBake, GivesTheSameBytesOnAnyNumberOfThreadsAndResumed) {
    const FieldRequest fields{.of_vertices = true, .resolution = 256};
    parameters_.vertices = 100;
    parameters_.threads = 1;
    (void)baked("one", fields);
    parameters_.threads = 3;
    bool stops = false;
    const BakeHooks stop{.on_progress =
                             [&](const BakeProgress& progress) {
                                 stops = progress.stage == BakeStage::visibility;
                             },
                         .should_stop = [&] { return stops; }};
    EXPECT_THROW((void)baked("three", fields, stop), BakeInterrupted);
    (void)baked("three", fields);
    for (const char* file : {"manifest.json", "visibility.bin"}) {
        EXPECT_TRUE(bytes_of(path("one") / file) == bytes_of(path("three") / file)) << file;
    }
}

// However long it takes to find the vertices.
TEST_F(VertexFieldBake, StatesItsMemoryBeforeItBegins) {
    std::vector<std::string> notes;
    const BakeHooks stop{.on_note = [&](const std::string& said) { notes.push_back(said); },
                         .should_stop = [] { return true; }};
    EXPECT_THROW((void)baked("v.relume", {.of_vertices = true, .resolution = 64}, stop),
                 BakeInterrupted);
    ASSERT_EQ(notes.size(), 1U);
    // 600 times 3072 bytes.
    EXPECT_NE(notes[0].find("at most 600 vertices, 6×64×64 bits each: at most 1.8 MB"),
              std::string::npos)
        << notes[0];
}

// A file may have no normals: triangles have their own then, and every vertex one of them.
TEST_F(VertexFieldBake, OfASceneWithoutNormalsSeesOverItsTriangles) {
    for (scene::Mesh& mesh : scene_.meshes) {
        mesh.normals.clear();
    }
    scene::finish_scene(scene_);
    const auto transport = baked("flat.relume", {.of_vertices = true});
    const auto& normals = transport->surface()->mesh.normals;
    ASSERT_EQ(normals.size(), transport->surface()->mesh.vertex_count());
    ASSERT_EQ(transport->visibility()->point_count(), normals.size());
    const std::size_t words = transport->visibility()->words_per_point();
    std::vector<std::uint64_t> bits;
    std::size_t vertex = 0;
    std::size_t open = 0;
    for (std::uint32_t block = 0; block < transport->visibility()->block_count(); ++block) {
        transport->visibility()->read(block, bits);
        for (std::size_t first = 0; first < bits.size(); first += words, ++vertex) {
            EXPECT_NEAR(normals[vertex].length(), 1, 1e-3) << vertex;
            for (std::size_t texel = 0; texel < basis::texel_count(8); ++texel) {
                if (transport::is_open(std::span(bits).subspan(first, words), texel)) {
                    ++open;
                    // A texel's middle may lie a little below where a part of it is above.
                    const auto direction =
                        basis::direction_from_texel(8, basis::texel_from_index(8, texel));
                    EXPECT_GT(direction.dot(normals[vertex]), -0.2F) << vertex;
                }
            }
        }
    }
    EXPECT_GT(open, normals.size());
}

TEST_F(VertexFieldBake, NamesWhatIsWrong) {
    const auto fault = [&](const FieldRequest& fields) {
        try {
            check_fields(fields, parameters_);
        } catch (const program::UsageError& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_EQ(fault({.of_vertices = true, .resolution = 256}), "none");
    EXPECT_NE(fault({.of_vertices = true, .resolution = 512}).find("4 to 256"),
              std::string::npos);
    EXPECT_NE(fault({.editable = {"red"}, .of_vertices = true}).find("--editable is for"),
              std::string::npos);
    parameters_.receivers = ReceiverKind::pixels;
    EXPECT_NE(fault({.of_vertices = true}).find("--receivers vertices beside"),
              std::string::npos);
}

}  // namespace
}  // namespace relume::bake
