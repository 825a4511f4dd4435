// The glTF files under tests/cases/scenes, each with the right value that its README states.
#include "precompute/scene/error.h"
#include "tests/unit/scene/case_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

using test::colour_at;
using test::expect_quadrants;
using test::import_case;
using test::mentions;
using test::surface_at;

void expect_near(const Imath::V3f& a, const Imath::V3f& b, float tolerance = 1e-4F) {
    EXPECT_LT((a - b).length(), tolerance) << a << " and " << b;
}

std::string all_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line + "; ";
    return text;
}

TEST(GltfCases, PercentEncodedUris) {
    for (const char* file : {"plain", "my scene", "texonly", "utf8bin", "rawutf8"}) {
        SCOPED_TRACE(file);
        const Scene scene =
            import_case("01-percent-encoded-uris/" + std::string(file) + ".gltf");
        expect_quadrants(scene);
        EXPECT_TRUE(scene.report.unused.empty()) << all_lines(scene.report.unused);
    }
}

TEST(GltfCases, NormalizedTextureCoordinatesAndColours) {
    expect_quadrants(import_case("02-normalized-texcoords-colours/ubyte_uv.gltf"));
    for (const char* file : {"col_f4", "col_u1", "col_u1_vec3", "col_u2"}) {
        SCOPED_TRACE(file);
        const Scene scene =
            import_case("02-normalized-texcoords-colours/" + std::string(file) + ".gltf");
        expect_near(colour_at(scene, 0.3F, 0.2F), {0.8F, 0.1F, 0.1F}, 5e-3F);
    }
}

TEST(GltfCases, MeshQuantization) {
    expect_quadrants(import_case("03-mesh-quantization/short_plain.gltf"));
    const Scene floats = import_case("03-mesh-quantization/nrm_f4.gltf");
    for (const char* file : {"nrm_i2", "nrm_i1"}) {
        SCOPED_TRACE(file);
        const Scene scene = import_case("03-mesh-quantization/" + std::string(file) + ".gltf");
        for (const float x : {-1.2F, 0.1F, 0.7F}) {
            const auto expected = surface_at(floats, x, 0.3F);
            const auto found = surface_at(scene, x, 0.3F);
            ASSERT_TRUE(expected && found);
            expect_near(found->shading.normal, expected->shading.normal, 0.01F);
        }
    }
}

// rot90 turns (u, v) into (v, 1 − u): each corner shows what the next one showed.
TEST(GltfCases, TextureTransform) {
    const Scene moved = import_case("04-texture-transform/offset_scale.gltf");
    for (const float x : {-1.2F, 1.2F}) {
        for (const float y : {-1.2F, 1.2F}) {
            const Imath::V3f green = colour_at(moved, x, y);
            EXPECT_TRUE(green.y > 0.3F && green.x < 0.1F && green.z < 0.1F) << green;
        }
    }
    const Scene plain = import_case("11-skinned-scaled-armature/noskin.gltf");
    const Scene turned = import_case("04-texture-transform/rot90.gltf");
    // The quad reaches from −1.6 to 1.6; u to the right, v downwards.
    for (const float x : {-0.8F, 0.8F}) {
        for (const float y : {-0.8F, 0.8F})
            expect_near(colour_at(turned, x, y), colour_at(plain, -y, x));
    }
    const Scene twice = import_case("04-texture-transform/scale2.gltf");
    for (const float x : {-1.2F, -0.4F, 0.4F, 1.2F})
        expect_near(colour_at(twice, x, 1.2F),
                    colour_at(plain, x < 0 ? 2 * x + 1.6F : 2 * x - 1.6F, 0.8F), 0.02F);
    EXPECT_TRUE(turned.report.unused.empty()) << all_lines(turned.report.unused);
}

TEST(GltfCases, CamerasBelongToNodes) {
    for (const char* file : {"dup", "nested", "noaspect", "noname", "ortho_first", "twice",
                             "twoscenes", "unused_first", "wide"}) {
        SCOPED_TRACE(file);
        const Scene scene = import_case("05-camera-names/" + std::string(file) + ".gltf");
        expect_near(Imath::V3f(scene.frame.origin), {0, 0, 5});
        const Camera camera(scene.camera, 10, 10);
        expect_near(camera.forward(), {0, 0, -1});
        EXPECT_NEAR(scene.camera.vertical_fov_degrees, 40.0F, 1e-3F);
        expect_quadrants(scene);
    }
    EXPECT_TRUE(mentions(import_case("05-camera-names/ortho_first.gltf").report.unused,
                         "camera 'oc' of node 2 'oc': orthographic"));
    EXPECT_TRUE(mentions(import_case("05-camera-names/twice.gltf").report.unused, "Cam B"));
    EXPECT_TRUE(
        mentions(import_case("05-camera-names/twoscenes.gltf").report.unused, "1 of 2 scenes"));
    EXPECT_TRUE(mentions(import_case("05-camera-names/unused_first.gltf").report.unused,
                         "no node of the scene"));
}

TEST(GltfCases, GpuInstancing) {
    const Scene instanced = import_case("06-gpu-instancing/instanced.gltf");
    const Scene nodes = import_case("06-gpu-instancing/nodes.gltf");
    EXPECT_EQ(instanced.triangle_count(), 8U);
    int covered = 0;
    for (float x = -1.95F; x < 2; x += 0.1F) {
        for (float y = -1.95F; y < 2; y += 0.1F) {
            EXPECT_EQ(surface_at(instanced, x, y).has_value(),
                      surface_at(nodes, x, y).has_value());
            covered += surface_at(instanced, x, y) ? 1 : 0;
        }
    }
    EXPECT_EQ(covered, 400);  // four unit quads, a hundred places each
}

TEST(GltfCases, WebpPictures) {
    expect_quadrants(import_case("07-webp-basisu-textures/webp.gltf"));
    expect_quadrants(import_case("07-webp-basisu-textures/webp_fallback.gltf"));
}

TEST(GltfCases, NormalMapsOnMirroredSurfaces) {
    const auto tilt = [](const char* file) {
        const auto point =
            surface_at(import_case("09-mirrored-normal-map/" + std::string(file)), 0.3F, 0.2F);
        return point ? point->shading.normal : Imath::V3f(0);
    };
    // The map's texels say (191, 128, 238).
    const Imath::V3f expected =
        Imath::V3f(2 * 191 / 255.0F - 1, 2 * 128 / 255.0F - 1, 2 * 238 / 255.0F - 1)
            .normalized();
    expect_near(tilt("plain.gltf"), expected, 2e-3F);
    const Imath::V3f mirrored(-expected.x, expected.y, expected.z);
    expect_near(tilt("mirror_node.gltf"), mirrored, 2e-3F);
    expect_near(tilt("mirror_uv.gltf"), mirrored, 2e-3F);
    // Without a map: a smooth surface and its mirror images turn the same side to the light.
    for (const char* file : {"smooth_mx.gltf", "smooth_mxyz.gltf"}) {
        const Scene scene = import_case("09-mirrored-normal-map/" + std::string(file));
        const Scene straight = import_case("09-mirrored-normal-map/smooth.gltf");
        ASSERT_EQ(scene.meshes[0].normals.size(), straight.meshes[0].normals.size());
        const float y = std::string(file) == "smooth_mx.gltf" ? 1.0F : -1.0F;
        const Imath::V3f mirror(-1, y, y);
        for (std::size_t i = 0; i < scene.meshes[0].normals.size(); ++i)
            expect_near(scene.meshes[0].normals[i], straight.meshes[0].normals[i] * mirror);
    }
}

// A bump and its mirror image: mirrored places have mirrored normals.
TEST(GltfCases, ABumpAndItsMirrorImageAreAlike) {
    const Scene scene = import_case("09-mirrored-normal-map/bump_pair.gltf");
    int tilted = 0;
    for (float x = 0.1F; x < 0.7F; x += 0.13F) {
        for (float y = -0.6F; y < 0.7F; y += 0.11F) {
            const auto left = surface_at(scene, -0.85F + x, y);
            const auto right = surface_at(scene, 0.85F - x, y);
            ASSERT_TRUE(left && right);
            const Imath::V3f& n = left->shading.normal;
            expect_near(right->shading.normal, {-n.x, n.y, n.z}, 0.02F);
            tilted += std::abs(n.y) > 0.1F ? 1 : 0;
        }
    }
    EXPECT_GT(tilted, 10);
}

TEST(GltfCases, SpecularGlossiness) {
    const auto point =
        surface_at(import_case("10-specular-glossiness/specgloss.gltf"), 0.3F, 0.2F);
    ASSERT_TRUE(point);
    expect_near(point->bsdf.diffuse_colour(), {0.6F, 0.2F, 0.1F});
    expect_near(point->bsdf.specular_colour(), Imath::V3f(0.04F));
    EXPECT_NEAR(point->bsdf.alpha(), 0.81F, 1e-5F);
    expect_quadrants(import_case("10-specular-glossiness/specgloss_tex.gltf"));
}

TEST(GltfCases, SkinsTakeTheirJointsPose) {
    for (const char* file : {"noskin", "skin_armature", "skin_identity_pose"}) {
        SCOPED_TRACE(file);
        const Scene scene =
            import_case("11-skinned-scaled-armature/" + std::string(file) + ".gltf");
        expect_quadrants(scene);
        expect_near(scene.bounds().max, {1.6F, 1.6F, 0});
    }
    const Scene posed = import_case("11-skinned-scaled-armature/skin_posed.gltf");
    expect_near(posed.bounds().min, {-1.6F, -1.6F, -5});
    expect_near(posed.bounds().max, {1.6F, 1.6F, -5});
}

TEST(GltfCases, PixelFormatsOfTextures) {
    for (const char* file :
         {"datauri.gltf", "glb_jpeg_said_png.glb", "glb_nomime.glb", "glb_png.glb",
          "glb_png_said_jpeg.glb", "gama_png.gltf", "jpeg_named_png.gltf", "pal2_png.gltf",
          "pal8_png.gltf", "pal8_trns_png.gltf", "png_named_jpg.gltf", "rgb16_png.gltf",
          "rgba16_png.gltf", "rgba_png.gltf", "tex_jpg.gltf", "trns_rgb_png.gltf"}) {
        SCOPED_TRACE(file);
        expect_quadrants(import_case("15-texture-pixel-formats/" + std::string(file)));
    }
    for (const char* file : {"grey1_png.gltf", "greyalpha_png.gltf"}) {
        SCOPED_TRACE(file);
        const Imath::V3f grey = colour_at(
            import_case("15-texture-pixel-formats/" + std::string(file)), -0.8F, 0.8F);
        EXPECT_TRUE(grey.x >= 0 && grey.x == grey.y && grey.y == grey.z) << grey;
    }
}

TEST(GltfCases, SpecularAndIndexOfRefraction) {
    const auto f0 = [](const char* file) {
        const auto point =
            surface_at(import_case("16-material-extensions/" + std::string(file)), 0.3F, 0.2F);
        return point ? point->bsdf.specular_colour() : Imath::V3f(-1);
    };
    expect_near(f0("black_dielectric.gltf"), Imath::V3f(0.04F));
    expect_near(f0("specular0.gltf"), Imath::V3f(0));
    expect_near(f0("ior24.gltf"), Imath::V3f(0.1724F));
    expect_near(f0("specular_colour.gltf"), {0.04F, 0, 0});
    expect_near(f0("base_over_one.gltf"), Imath::V3f(1));
    const auto bare =
        surface_at(import_case("16-material-extensions/specular0.gltf"), 0.3F, 0.2F);
    ASSERT_TRUE(bare);
    expect_near(bare->bsdf.evaluate(Imath::V3f(0.9F, 0, 0.2F).normalized(),
                                    Imath::V3f(-0.9F, 0, 0.2F).normalized()),
                Imath::V3f(0));
}

TEST(GltfCases, WhatIsNotShownIsNamed) {
    const auto unused = [](const char* file) {
        return import_case("16-material-extensions/" + std::string(file)).report.unused;
    };
    EXPECT_TRUE(mentions(unused("clearcoat.gltf"), "clear coat (KHR_materials_clearcoat)"));
    EXPECT_TRUE(mentions(unused("emissive_strength.gltf"), "KHR_materials_emissive_strength"));
    EXPECT_TRUE(mentions(unused("iridescence_aniso.gltf"), "KHR_materials_iridescence"));
    EXPECT_TRUE(mentions(unused("iridescence_aniso.gltf"), "KHR_materials_anisotropy"));
    EXPECT_TRUE(mentions(unused("transmission.gltf"), "KHR_materials_transmission"));
    EXPECT_TRUE(mentions(unused("unlit.gltf"), "unlit"));
    const auto matte = surface_at(import_case("16-material-extensions/unlit.gltf"), 0.3F, 0.2F);
    ASSERT_TRUE(matte);
    EXPECT_EQ(matte->bsdf.model(), BsdfModel::lambert);
    expect_near(matte->bsdf.diffuse_colour(), {0.8F, 0.2F, 0.1F});
}

}  // namespace
}  // namespace relume::scene
