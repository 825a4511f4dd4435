// OBJ with MTL, and PLY.
#include "precompute/scene/import.h"
#include "precompute/scene/srgb.h"
#include "precompute/scene/surface_point.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace relume::scene {
namespace {

class ImportFormats : public testing::Test {
  protected:
    Scene import(const std::string& file) {
        ImportOptions options;
        options.camera = {.eye = Imath::V3d(0, 0, 4), .look_at = Imath::V3d(0, 0, 0)};
        return import_scene(scratch_.path() / file, options);
    }
    void write(const std::string& file, const std::string& text) {
        test::write_text(scratch_.path() / file, text);
    }
    static const Material& material(const Scene& scene, const std::string& name) {
        return *std::find_if(scene.materials.begin(), scene.materials.end(),
                             [&](const Material& m) { return m.name == name; });
    }
    test::ScratchDirectory scratch_;
};

bool mentions(const std::vector<std::string>& lines, const std::string& word) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(word) != std::string::npos;
    });
}

constexpr const char* kQuad =
    "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST_F(ImportFormats, MtlBecomesLambertOrPhong) {
    write("quad.obj",
          std::string(kQuad) + "usemtl dull\nf 1/1 2/2 3/3\nusemtl shiny\nf 1/1 3/3 4/4\n");
    write("quad.mtl",
          "newmtl dull\nKd 0.5 0.4 0.3\nillum 2\n"
          "newmtl shiny\nKd 0.2 0.2 0.2\nKs 0.5 0.5 0.5\nNs 40\nillum 2\n");
    const Scene scene = import("quad.obj");
    EXPECT_EQ(scene.triangle_count(), 2U);
    const Material& dull = material(scene, "dull");
    EXPECT_EQ(dull.model, BsdfModel::lambert);
    EXPECT_EQ(dull.base_colour, Imath::V3f(0.5F, 0.4F, 0.3F));
    const Material& shiny = material(scene, "shiny");
    EXPECT_EQ(shiny.model, BsdfModel::phong);
    EXPECT_EQ(shiny.specular, Imath::V3f(0.5F));
    EXPECT_EQ(shiny.exponent, 40.0F);
}

TEST_F(ImportFormats, MtlTexturesBesideTheScene) {
    test::write_red_green(scratch_.path() / "rg.png");
    write("quad.obj", std::string(kQuad) + "usemtl painted\nf 1/1 2/2 3/3 4/4\n");
    write("quad.mtl", "newmtl painted\nKd 1 1 1\nmap_Kd rg.png\n");
    const Scene scene = import("quad.obj");
    EXPECT_EQ(scene.triangle_count(), 2U);
    ASSERT_EQ(scene.textures.size(), 1U);
    const Imath::V4f left = scene.textures[0].evaluate({0.25F, 0.5F});
    EXPECT_EQ(left, Imath::V4f(1, 0, 0, 1));
}

TEST_F(ImportFormats, NothingOutsideTheFolderIsOpened) {
    std::filesystem::create_directory(scratch_.path() / "inner");
    test::write_red_green(scratch_.path() / "rg.png");
    write("secret.mtl", "newmtl painted\nKd 0.9 0.1 0.1\n");
    for (const std::string& reference : {std::string("../rg.png"), std::string("..\\rg.png"),
                                         (scratch_.path() / "rg.png").string()}) {
        write("inner/quad.obj", std::string(kQuad) + "usemtl painted\nf 1/1 2/2 3/3 4/4\n");
        write("inner/quad.mtl", "newmtl painted\nKd 0.3 0.3 0.3\nmap_Kd " + reference + "\n");
        const Scene scene = import("inner/quad.obj");
        EXPECT_TRUE(scene.textures.empty()) << reference;
        EXPECT_TRUE(mentions(scene.report.unused, "outside the scene's folder")) << reference;
    }
    write("inner/quad.obj",
          "mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl painted\nf 1 2 3\n");
    const Scene scene = import("inner/quad.obj");
    EXPECT_TRUE(mentions(scene.report.unused, "secret.mtl"));
    EXPECT_FALSE(std::any_of(scene.materials.begin(), scene.materials.end(),
                             [](const Material& m) { return m.base_colour.x > 0.8F; }));
}

TEST_F(ImportFormats, MissingTextureAndTransparencyAreReported) {
    write("quad.obj", std::string(kQuad) + "usemtl painted\nf 1/1 2/2 3/3 4/4\n");
    write("quad.mtl", "newmtl painted\nKd 0.3 0.3 0.3\nd 0.5\nKe 1 1 1\nmap_Kd gone.png\n");
    const Scene scene = import("quad.obj");
    EXPECT_TRUE(mentions(scene.report.unused, "gone.png"));
    EXPECT_TRUE(mentions(scene.report.unused, "transparency"));
    EXPECT_TRUE(mentions(scene.report.unused, "emission"));
    EXPECT_EQ(material(scene, "painted").base_colour, Imath::V3f(0.3F));
}

TEST_F(ImportFormats, ExcessOfKdAndKsIsReportedAndScaledDown) {
    write("quad.obj", std::string(kQuad) + "usemtl bright\nf 1/1 2/2 3/3 4/4\n");
    write("quad.mtl", "newmtl bright\nKd 0.8 0.8 0.8\nKs 0.7 0.7 0.7\nNs 12\n");
    const Scene scene = import("quad.obj");
    EXPECT_TRUE(mentions(scene.report.repairs, "exceed 1"));
    const Bsdf bsdf = surface_point(scene, 0, 0, {0.2F, 0.2F}, {0, 0, -1}).bsdf;
    EXPECT_NEAR(bsdf.diffuse_colour().x + bsdf.specular_colour().x, 1.0F, 1e-6F);
}

TEST_F(ImportFormats, CreasesStaySharpWhereNormalsAreMissing) {
    // Two triangles at 90°, two more continuing the first flat.
    write("edge.obj",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 -1\n"
          "f 1 2 3\nf 2 4 3\nf 1 3 5\n");
    const Scene scene = import("edge.obj");
    EXPECT_TRUE(mentions(scene.report.repairs, "normals"));
    for (const Mesh& mesh : scene.meshes) {
        for (const Imath::V3f& normal : mesh.normals) {
            const float along_axis = std::max(std::abs(normal.x), std::abs(normal.z));
            EXPECT_NEAR(along_axis, 1.0F, 1e-5F);
        }
    }
}

// Five points joined each to the next but one: the middle is crossed twice, and so outside.
TEST_F(ImportFormats, FacesThatCrossThemselvesAreFilledEvenOdd) {
    write("pentagram.obj",
          "v 0 1 0 1 0 0\nv 0.588 -0.809 0 1 0 0\nv -0.951 0.309 0 1 0 0\n"
          "v 0.951 0.309 0 1 0 0\nv -0.588 -0.809 0 1 0 0\nvt 0 0\nf 1/1 2/1 3/1 4/1 5/1\n");
    const Scene star = import("pentagram.obj");
    EXPECT_FALSE(test::surface_at(star, 0.01F, 0.02F).has_value());
    EXPECT_LT((test::colour_at(star, 0.01F, 0.8F) - Imath::V3f(1, 0, 0)).length(), 1e-5F);
    EXPECT_TRUE(test::surface_at(star, 0.7F, 0.27F).has_value());
    write("bow.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
    const Scene bow = import("bow.obj");
    EXPECT_TRUE(test::surface_at(bow, 0.1F, 0.5F).has_value());
    EXPECT_TRUE(test::surface_at(bow, 0.9F, 0.5F).has_value());
    EXPECT_FALSE(test::surface_at(bow, 0.5F, 0.1F).has_value());
}

TEST_F(ImportFormats, TexturesAreMovedAndClampedAsTheirOptionsSay) {
    test::write_red_green(scratch_.path() / "rg.png");
    const auto left_quarter = [&](const std::string& options) {
        write("quad.obj", std::string(kQuad) + "usemtl painted\nf 1/1 2/2 3/3 4/4\n");
        write("quad.mtl", "newmtl painted\nmap_Kd " + options + " rg.png\n");
        return test::colour_at(import("quad.obj"), 0.25F, 0.5F);
    };
    const Imath::V3f red(1, 0, 0);
    const Imath::V3f green(0, 1, 0);
    EXPECT_LT((left_quarter("") - red).length(), 1e-3F);
    EXPECT_LT((left_quarter("-o 0.5 0 0") - green).length(), 1e-3F);
    EXPECT_LT((left_quarter("-s 3 1 1") - green).length(), 1e-3F);
    EXPECT_LT((left_quarter("-o 1.0") - red).length(), 1e-3F);
    EXPECT_LT((left_quarter("-clamp on -o 1.0") - green).length(), 1e-3F);
}

// Heights that rise to the right lean the normal to the left.
TEST_F(ImportFormats, BumpMapsAreHeights) {
    test::write_red_green(scratch_.path() / "rg.png");
    for (const char* keyword : {"bump", "map_Bump", "map_bump"}) {
        write("quad.obj", std::string(kQuad) + "usemtl rough\nf 1/1 2/2 3/3 4/4\n");
        write("quad.mtl", std::string("newmtl rough\nKd 0.5 0.5 0.5\n") + keyword +
                              " -imfchan g -clamp on -bm 2 rg.png\n");
        const Scene scene = import("quad.obj");
        ASSERT_TRUE(scene.materials[0].normal_texture.has_value()) << keyword;
    }
}

TEST_F(ImportFormats, TexturesOfShineAndMetal) {
    test::write_red_green(scratch_.path() / "rg.png");
    write("quad.obj", std::string(kQuad) + "usemtl m\nf 1/1 2/2 3/3 4/4\n");
    write("quad.mtl",
          "newmtl m\nKd 0.2 0.2 0.2\nKs 0.5 0.5 0.5\nNs 64\nmap_Ns -imfchan g "
          "rg.png\nmap_Ks rg.png\n");
    const Scene shiny = import("quad.obj");
    const auto left = test::surface_at(shiny, 0.25F, 0.5F);
    const auto right = test::surface_at(shiny, 0.75F, 0.5F);
    ASSERT_TRUE(left && right);
    EXPECT_EQ(left->bsdf.exponent(), 0.0F);
    EXPECT_EQ(right->bsdf.exponent(), 64.0F);
    EXPECT_NEAR(right->bsdf.specular_colour().y, 0.5F, 1e-3F);
    EXPECT_NEAR(right->bsdf.specular_colour().x, 0, 1e-3F);
    write("quad.mtl", "newmtl m\nKd 1 1 1\nmap_Pm -imfchan g rg.png\nPr 0.3\n");
    const Scene metal = import("quad.obj");
    EXPECT_GT(test::surface_at(metal, 0.25F, 0.5F)->bsdf.diffuse_colour().x, 0.5F);
    EXPECT_LT(test::surface_at(metal, 0.75F, 0.5F)->bsdf.diffuse_colour().x, 0.01F);
}

constexpr const char* kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 3\n"
    "property float x\nproperty float y\nproperty float z\n";

TEST_F(ImportFormats, PlyIsGreyUnlessItSaysOtherwise) {
    write("t.ply", std::string(kPlyHead) +
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const Scene scene = import("t.ply");
    EXPECT_EQ(scene.triangle_count(), 1U);
    const Bsdf bsdf = surface_point(scene, 0, 0, {0.2F, 0.2F}, {0, 0, -1}).bsdf;
    EXPECT_TRUE(bsdf.is_diffuse());
    EXPECT_EQ(bsdf.diffuse_colour(), Imath::V3f(0.5F));
}

TEST_F(ImportFormats, PlyColoursAreDisplayReferred) {
    write("t.ply", std::string(kPlyHead) +
                       "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 0 255 128 0\n1 0 0 255 128 0\n0 1 0 255 128 0\n3 0 1 2\n");
    const Scene scene = import("t.ply");
    const Bsdf bsdf = surface_point(scene, 0, 0, {0.2F, 0.2F}, {0, 0, -1}).bsdf;
    EXPECT_NEAR(bsdf.diffuse_colour().x, 1.0F, 1e-5F);
    EXPECT_NEAR(bsdf.diffuse_colour().y, linear_from_srgb(128.0F / 255.0F), 1e-4F);
    EXPECT_NEAR(bsdf.diffuse_colour().z, 0.0F, 1e-5F);
}

}  // namespace
}  // namespace relume::scene
