// Bakes of vertices: what is stored, seen again by rays.
#include "precompute/bake/bake.h"
#include "precompute/bake/base/error.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/program/usage.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/error.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

BakeParameters parameters_of_mesh() {
    BakeParameters parameters;
    parameters.receivers = ReceiverKind::vertices;
    parameters.width = 48;
    parameters.height = 32;
    parameters.face_resolution = 8;
    parameters.bounces = 2;
    parameters.samples = 64;
    parameters.vertices = 3000;
    parameters.target_error = 0.02;
    return parameters;
}

// Brighter from above and from one side, the same everywhere else.
CubemapLight sky_of(std::uint32_t n, float slope) {
    CubemapLight light;
    for (auto& plane : light) {
        plane.resize(basis::texel_count(n));
        for (std::size_t texel = 0; texel < plane.size(); ++texel) {
            const Imath::V3f d =
                basis::direction_from_texel(n, basis::texel_from_index(n, texel));
            plane[texel] = 1 + slope * (d.y + 0.5F * d.x);
        }
    }
    return light;
}

// Over the pixels that the scene fills: along its outline the two have other rays.
double relative_l2(const DenseImage& image, const DenseImage& truth) {
    double difference = 0;
    double norm = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t pixel = 0; pixel < truth.rgb[c].size(); ++pixel) {
            if (truth.coverage[pixel] < 1 || image.coverage[pixel] < 1) {
                continue;
            }
            difference += std::pow(image.rgb[c][pixel] - truth.rgb[c][pixel], 2);
            norm += std::pow(truth.rgb[c][pixel], 2);
        }
    }
    return std::sqrt(difference / norm);
}

class MeshBake : public testing::Test {
  protected:
    [[nodiscard]] std::shared_ptr<const transport::Transport> baked(
        const scene::Scene& scene, const BakeParameters& parameters, const char* name) const {
        bake(scene, parameters, scratch_.path() / name);
        return transport::Transport::open(scratch_.path() / name);
    }

    test::ScratchDirectory scratch_;
};

TEST_F(MeshBake, AnOpenPlaneShowsItsAlbedoUnderAConstantLight) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.materials[0].base_colour = {0.8F, 0.4F, 0.2F};
    const BakeParameters parameters = parameters_of_mesh();
    const auto transport = baked(scene, parameters, "plane.relume");
    const DenseImage seen = relight(*transport, sky_of(8, 0));
    for (std::size_t pixel = 0; pixel < seen.coverage.size(); ++pixel) {
        ASSERT_EQ(seen.coverage[pixel], 1);
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = scene.materials[0].base_colour[static_cast<int>(c)];
            ASSERT_NEAR(seen.rgb[c][pixel], expected, 5e-3 * expected);
        }
    }
}

TEST_F(MeshBake, ColoursOfVerticesAreSeen) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.materials[0].base_colour = {0.8F, 0.8F, 0.8F};
    // Two corners are red, two are blue: half of each in the middle.
    scene.meshes[0].colours.assign(scene.meshes[0].positions.size(), {1, 0.5F, 0});
    for (std::size_t i = 0; i < scene.meshes[0].positions.size(); ++i) {
        if (scene.meshes[0].positions[i].x > 0) {
            scene.meshes[0].colours[i] = {0, 0.5F, 1};
        }
    }
    const BakeParameters parameters = parameters_of_mesh();
    const auto transport = baked(scene, parameters, "plane.relume");
    const DenseImage seen = relight(*transport, sky_of(8, 0));
    const auto colour = [&](std::uint32_t x) {
        const std::size_t pixel = std::size_t{seen.height} / 2 * seen.width + x;
        return Imath::V3d(seen.rgb[0][pixel], seen.rgb[1][pixel], seen.rgb[2][pixel]);
    };
    EXPECT_GT(colour(0).x, 1.5 * colour(0).z);
    EXPECT_GT(colour(seen.width - 1).z, 1.5 * colour(seen.width - 1).x);
    for (const std::uint32_t x : {0U, seen.width / 2, seen.width - 1}) {
        EXPECT_NEAR(colour(x).y, 0.4, 0.01);
        EXPECT_NEAR(colour(x).x + colour(x).z, 0.8, 0.04);
    }
}

// The same scene baked for its one camera shows the same. Colours bleed from wall to wall in
// it.
TEST_F(MeshBake, TheSceneOwnCameraSeesWhatAnImageBakeShows) {
    const scene::Scene scene = scene::build_builtin_scene("box");
    BakeParameters parameters = parameters_of_mesh();
    const auto mesh = baked(scene, parameters, "mesh.relume");
    parameters.receivers = ReceiverKind::pixels;
    const auto image = baked(scene, parameters, "image.relume");
    const CubemapLight light = sky_of(8, 0.8F);
    const double error = relative_l2(relight(*mesh, light), relight(*image, light));
    std::printf("  relative L2 to the image bake: %.4f\n", error);
    EXPECT_LT(error, 0.04);
}

// A sheet of a material with holes over the floor, seen from above: its outline is that of the
// holes, and through them shows the floor.
TEST_F(MeshBake, HolesAreSeen) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.materials[0].base_colour = {0.8F, 0.1F, 0.1F};
    constexpr std::uint32_t kTexels = 4;
    std::vector<half> rgba;
    for (std::uint32_t i = 0; i < kTexels * kTexels; ++i) {
        const bool is_solid = (i % kTexels + i / kTexels) % 2 == 0;
        rgba.insert(rgba.end(), {half(1), half(1), half(1), half(is_solid ? 1 : 0)});
    }
    scene.textures.emplace_back("holes", kTexels, kTexels, std::move(rgba));
    scene.materials.push_back({.name = "sheet",
                               .base_colour = {0.1F, 0.1F, 0.8F},
                               .alpha_cutoff = 0.5F,
                               .base_texture = scene::TextureUse(0)});
    scene::Mesh sheet;
    sheet.name = "sheet";
    sheet.material = 1;
    sheet.positions = {
        {-0.5F, 0.3F, 0.5F}, {0.5F, 0.3F, 0.5F}, {0.5F, 0.3F, -0.5F}, {-0.5F, 0.3F, -0.5F}};
    sheet.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(std::move(sheet));
    scene.camera = {.name = "above",
                    .eye = {0.1F, 2, 0.4F},
                    .look_at = {0, 0, 0},
                    .up = {0, 0, -1},
                    .vertical_fov_degrees = 40};
    scene::finish_scene(scene);
    BakeParameters parameters = parameters_of_mesh();
    parameters.bounces = 0;
    const auto mesh = baked(scene, parameters, "mesh.relume");
    ASSERT_TRUE(mesh->manifest().mesh->materials[1].cutout);
    parameters.receivers = ReceiverKind::pixels;
    const auto image = baked(scene, parameters, "image.relume");
    const CubemapLight light = sky_of(8, 0);
    const DenseImage seen = relight(*mesh, light);
    const DenseImage truth = relight(*image, light);
    // What is blue shows the sheet.
    std::size_t blue = 0;
    std::size_t differs = 0;
    for (std::size_t pixel = 0; pixel < truth.rgb[0].size(); ++pixel) {
        const bool is_sheet = truth.rgb[2][pixel] > truth.rgb[0][pixel];
        blue += is_sheet ? 1U : 0U;
        differs += is_sheet != (seen.rgb[2][pixel] > seen.rgb[0][pixel]) ? 1U : 0U;
    }
    EXPECT_GT(blue, 50U);
    EXPECT_LT(differs, blue / 20);
}

// A glossy floor: its K terms agree with the bake of its own BSDF by what the bake states.
TEST_F(MeshBake, TermsShowTheBrdfWithinTheErrorThatIsStated) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.materials[0] = {.name = "satin",
                          .model = scene::BsdfModel::phong,
                          .base_colour = {0.3F, 0.3F, 0.3F},
                          .specular = {0.4F, 0.3F, 0.2F},
                          .exponent = 1};
    scene.camera = {
        .name = "low", .eye = {0, 1, 2.2F}, .look_at = {0, 0, 0}, .vertical_fov_degrees = 20};
    BakeParameters parameters = parameters_of_mesh();
    parameters.bounces = 0;
    parameters.vertices = 200;
    parameters.pixel_samples = 16;
    parameters.target_error = 0.02;
    const auto mesh = baked(scene, parameters, "mesh.relume");
    const nlohmann::json brdf = mesh->manifest().measured.at("brdfs").at(0);
    EXPECT_GT(brdf.at("terms").get<int>(), 1);
    EXPECT_EQ(mesh->manifest().layout.clusters().clusters()[0].terms,
              brdf.at("terms").get<std::uint32_t>());
    parameters.receivers = ReceiverKind::pixels;
    const auto image = baked(scene, parameters, "image.relume");
    const CubemapLight light = sky_of(8, 0.9F);
    const double error = relative_l2(relight(*mesh, light), relight(*image, light));
    std::printf("  relative L2 to the image bake: %.4f, %d terms of L2 %.4f\n", error,
                brdf.at("terms").get<int>(), brdf.at("error").get<double>());
    EXPECT_LT(error, 2 * brdf.at("error").get<double>());
}

TEST_F(MeshBake, TheSameInputsGiveTheSameBytesOnAnyNumberOfThreads) {
    const scene::Scene scene = scene::build_builtin_scene("box");
    BakeParameters parameters = parameters_of_mesh();
    parameters.vertices = 500;
    parameters.threads = 1;
    bake(scene, parameters, scratch_.path() / "one.relume");
    parameters.threads = 3;
    bake(scene, parameters, scratch_.path() / "three.relume");
    const auto bytes = [&](const char* folder, const char* file) {
        std::ifstream stream(scratch_.path() / folder / file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    for (const char* file :
         {"manifest.json", "mesh.bin", "brdfs.bin", "textures.bin", "columns.bin",
          "receivers.bin", "sketch.bin", "shards/00000.shard"}) {
        EXPECT_FALSE(bytes("one.relume", file).empty()) << file;
        EXPECT_TRUE(bytes("one.relume", file) == bytes("three.relume", file)) << file;
    }
}

TEST_F(MeshBake, IsWholeAndEveryDamagedFileIsRefusedByName) {
    const fs::path directory = scratch_.path() / "box.relume";
    BakeParameters parameters = parameters_of_mesh();
    parameters.vertices = 500;
    bake(scene::build_builtin_scene("box"), parameters, directory);
    EXPECT_TRUE(find_faults(directory).empty());
    for (const char* name : {"mesh.bin", "brdfs.bin"}) {
        const fs::path file = directory / name;
        std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
        stream.seekg(40);
        const char before = static_cast<char>(stream.get());
        stream.seekp(40);
        stream.put(static_cast<char>(before ^ 1));
        stream.flush();
        try {
            (void)transport::Transport::open(directory);
            ADD_FAILURE() << name;
        } catch (const transport::TransportError& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
        stream.seekp(40);
        stream.put(before);
    }
    EXPECT_TRUE(find_faults(directory).empty());
}

TEST_F(MeshBake, BlocksAreStoredInTheBasisOfTheFewestBytes) {
    BakeParameters parameters = parameters_of_mesh();
    parameters.bounces = 0;
    const auto transport = baked(scene::build_builtin_scene("box"), parameters, "box.relume");
    const transport::Manifest& manifest = transport->manifest();
    const nlohmann::json& bytes = manifest.measured.at("bytes_of_basis");
    ASSERT_EQ(bytes.size(), 2U);
    const std::string chosen(transport::kBlockBasisNames.name(manifest.block_basis));
    for (const auto& [basis, of_basis] : bytes.items()) {
        EXPECT_GT(of_basis.get<double>(), 0);
        EXPECT_LE(bytes.at(chosen), of_basis) << basis;
    }
}

TEST_F(MeshBake, RefusesFewerVerticesThanTheSceneHas) {
    BakeParameters parameters = parameters_of_mesh();
    parameters.vertices = 10;
    try {
        bake(scene::build_builtin_scene("box"), parameters, scratch_.path() / "box.relume");
        ADD_FAILURE();
    } catch (const BakeError& error) {
        EXPECT_NE(std::string(error.what()).find("at most 10"), std::string::npos)
            << error.what();
    }
    parameters.terms = 11;
    EXPECT_THROW(
        bake(scene::build_builtin_scene("box"), parameters, scratch_.path() / "box.relume"),
        program::UsageError);
}

// What files hold that nobody would draw: each is baked, whole, and shows finite values.
struct OddScene {
    const char* name;
    std::size_t triangles;  // of the surface before it is refined, both sides
    scene::Mesh (*mesh)();
};

scene::Mesh one_triangle() {
    scene::Mesh mesh;
    mesh.positions = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

// Three pages at one edge.
scene::Mesh not_a_manifold() {
    scene::Mesh mesh;
    mesh.positions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    return mesh;
}

// A triangle, the same again, one on a line, one with a corner twice.
scene::Mesh without_area() {
    scene::Mesh mesh = one_triangle();
    mesh.positions.push_back({0, 0, 1});
    mesh.triangles.insert(mesh.triangles.end(), {{0, 1, 2}, {0, 3, 1}, {0, 1, 1}});
    return mesh;
}

// Of three normals one is none.
scene::Mesh missing_normals() {
    scene::Mesh mesh = one_triangle();
    mesh.normals = {{0, 1, 0}, {0, 0, 0}, {0, 1, 0}};
    return mesh;
}

class OddMeshBake : public testing::TestWithParam<OddScene> {};

TEST_P(OddMeshBake, IsWholeAndFinite) {
    scene::Scene scene;
    scene.name = GetParam().name;
    scene.materials.push_back({.name = "white"});
    scene.meshes.push_back(GetParam().mesh());
    scene.camera = {.name = "above",
                    .eye = {0.3F, 2, 1},
                    .look_at = {0, 0.2F, 0},
                    .vertical_fov_degrees = 60};
    finish_scene(scene);
    const test::ScratchDirectory scratch;
    const fs::path directory = scratch.path() / "odd.relume";
    BakeParameters parameters = parameters_of_mesh();
    parameters.vertices = 200;
    bake(scene, parameters, directory);
    EXPECT_TRUE(find_faults(directory).empty());
    const auto transport = transport::Transport::open(directory);
    EXPECT_GE(transport->surface()->mesh.triangles.size(), GetParam().triangles);
    const DenseImage seen = relight(*transport, sky_of(8, 0.5F));
    double covered = 0;
    double sum = 0;
    for (std::size_t pixel = 0; pixel < seen.coverage.size(); ++pixel) {
        covered += double{seen.coverage[pixel]};
        for (const auto& plane : seen.rgb) {
            ASSERT_TRUE(std::isfinite(plane[pixel]));
            sum += plane[pixel];
        }
    }
    EXPECT_GT(covered, 10);
    EXPECT_GT(sum, 0.3 * covered);
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         OddMeshBake,
                         testing::Values(OddScene{"one_triangle", 2, one_triangle},
                                         OddScene{"not_a_manifold", 6, not_a_manifold},
                                         OddScene{"without_area", 2, without_area},
                                         OddScene{"missing_normals", 2, missing_normals}),
                         [](const auto& scene) { return std::string(scene.param.name); });

// One term cannot hold a sharp highlight: it is baked as was asked for, and the report says how
// far off it is and that the target is missed.
TEST_F(MeshBake, TooFewTermsAreBakedAndTold) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.materials[0] = {.name = "gloss",
                          .model = scene::BsdfModel::phong,
                          .base_colour = {0.1F, 0.1F, 0.1F},
                          .specular = {0.6F, 0.6F, 0.6F},
                          .exponent = 60};
    BakeParameters parameters = parameters_of_mesh();
    parameters.bounces = 0;
    parameters.vertices = 100;
    parameters.terms = 1;
    const auto transport = baked(scene, parameters, "plane.relume");
    const nlohmann::json brdf = transport->manifest().measured.at("brdfs").at(0);
    EXPECT_EQ(brdf.at("terms"), 1);
    EXPECT_FALSE(brdf.at("meets_target").get<bool>());
    EXPECT_GT(brdf.at("error").get<double>(), 0.3);
    EXPECT_EQ(brdf.at("error"), brdf.at("error_of_terms").at(0));
    const DenseImage seen = relight(*transport, sky_of(8, 0.9F));
    for (const auto& plane : seen.rgb) {
        for (const double value : plane) {
            ASSERT_TRUE(std::isfinite(value));
        }
    }
}

}  // namespace
}  // namespace relume::bake
