// The OBJ files under tests/cases/scenes, each with the right value that its README states.
#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"
#include "tests/unit/scene/case_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

using test::colour_at;
using test::expect_quadrants;
using test::import_case;
using test::mentions;
using test::surface_at;

Scene names(const std::string& file) {
    return import_case("20-obj-mtl-names/" + file);
}
Scene geometry(const std::string& file) {
    return import_case("21-obj-geometry/" + file);
}

void expect_near(const Imath::V3f& a, const Imath::V3f& b, float tolerance = 1e-3F) {
    EXPECT_LT((a - b).length(), tolerance) << a << " and " << b;
}

TEST(ObjCases, TexturesAreFoundWhateverTheirNamesLookLike) {
    for (const char* file : {"plain", "bom", "crlf", "tabs", "cont", "negidx", "uvw", "case",
                             "spaces", "winabs", "opts_mix", "nokd"}) {
        SCOPED_TRACE(file);
        const Scene scene = names(std::string(file) + ".obj");
        expect_quadrants(scene);
        EXPECT_TRUE(scene.report.unused.empty()) << scene.report.unused[0];
    }
}

TEST(ObjCases, AMaterialWithoutKdShowsItsTextureUnscaled) {
    const Scene scene = names("nokd.obj");
    const Scene plain = names("plain.obj");
    for (const float x : {-0.8F, 0.8F})
        expect_near(colour_at(scene, x, 0.8F), colour_at(plain, x, 0.8F), 1e-6F);
}

TEST(ObjCases, KdOfZeroIsBlackAndSaysSo) {
    const Scene scene = names("kd0.obj");
    expect_near(colour_at(scene, 0.8F, 0.8F), {0, 0, 0}, 1e-6F);
    EXPECT_TRUE(mentions(scene.report.repairs, "Kd is 0"));
}

// opts.obj repeats twice each way: each quarter of the quad shows all four colours.
TEST(ObjCases, ScaleOfTextureCoordinates) {
    const Scene twice = names("opts.obj");
    const Scene plain = names("plain.obj");
    for (const float x : {-0.4F, 0.4F}) {
        for (const float y : {-0.4F, 0.4F}) {
            for (const float left : {-0.8F, 0.8F}) {
                for (const float low : {-0.8F, 0.8F})
                    expect_near(colour_at(twice, left + x, low + y),
                                colour_at(plain, 2 * x, 2 * y), 0.02F);
            }
        }
    }
}

TEST(ObjCases, WhatIsMissingIsNamed) {
    EXPECT_TRUE(mentions(names("missingmtl.obj").report.unused, "nothere.mtl"));
    EXPECT_TRUE(mentions(names("latin1.obj").report.unused, "gr\\xfcn.png"));
    EXPECT_TRUE(mentions(names("ka_only.obj").report.unused, "map ka"));
}

TEST(ObjCases, NamesOfAnyBytesAreTextInTheReport) {
    for (const char* file :
         {"latin1_opaque", "latin1_transparent", "utf8_transparent", "gbk_gloss"}) {
        SCOPED_TRACE(file);
        const Scene scene = import_case("22-obj-non-utf8-names/" + std::string(file) + ".obj");
        for (const auto* lines : {&scene.report.unused, &scene.report.repairs}) {
            for (const std::string& line : *lines)
                EXPECT_EQ(shown_text(line), line);
        }
        for (const Material& material : scene.materials)
            EXPECT_EQ(shown_text(material.name), material.name);
    }
    const Scene opaque = import_case("22-obj-non-utf8-names/latin1_opaque.obj");
    expect_near(colour_at(opaque, 0, 0.1F), {0.2F, 0.6F, 0.2F});
}

// Whether the face covers a point; even-odd.
bool covers(const Scene& scene, float x, float y) {
    return surface_at(scene, x, y).has_value();
}

TEST(ObjCases, ConcaveFacesAreFilledEvenOdd) {
    for (const char* file : {"L.obj", "L_cw.obj"}) {
        const Scene l = geometry(file);
        EXPECT_TRUE(covers(l, -1, 1) && covers(l, 1, -1) && covers(l, -1, -1)) << file;
        EXPECT_FALSE(covers(l, 0.5F, 0.5F)) << file;
    }
    const Scene arrow = geometry("arrow4.obj");
    EXPECT_TRUE(covers(arrow, -0.5F, 0) && covers(arrow, 0.5F, 0) && covers(arrow, 0, 1));
    EXPECT_FALSE(covers(arrow, 0, -0.5F));
    const Scene star = geometry("star.obj");
    EXPECT_TRUE(covers(star, 0.01F, 0) && covers(star, 0.01F, 1.2F) && covers(star, 1, 0.4F));
    EXPECT_FALSE(covers(star, 0.7F, 1) || covers(star, 0.01F, -0.8F));
    const Scene ring = geometry("keyhole.obj");
    EXPECT_TRUE(covers(ring, 1, 0.1F) && covers(ring, 0.1F, 1) && covers(ring, -1, 0.1F));
    EXPECT_FALSE(covers(ring, 0.1F, 0.1F));
    const Scene notch = geometry("collinear.obj");
    EXPECT_TRUE(covers(notch, 1, 1) && covers(notch, 0.1F, -1) && covers(notch, -1.2F, 0));
    EXPECT_FALSE(covers(notch, -0.25F, 1));
    const Scene many = geometry("ngon1000.obj");
    EXPECT_TRUE(covers(many, 0.01F, 0.02F));
    EXPECT_FALSE(covers(many, 3, 3));
}

TEST(ObjCases, NegativeIndicesCountFromWhatWasRead) {
    const Scene scene = geometry("neg_interleaved.obj");
    for (const float y : {-0.8F, 0.8F}) {
        for (const float x : {-1.0F, 1.0F})
            EXPECT_TRUE(covers(scene, x, y)) << x << ' ' << y;
    }
}

TEST(ObjCases, VertexColoursAreTheWholeColour) {
    expect_near(colour_at(geometry("vcol.obj"), 0, 0.1F), {0.6038F, 0.01F, 0.01F}, 2e-3F);
    const Scene bytes = geometry("vcol255.obj");
    expect_near(colour_at(bytes, 0, 0.1F), {0.6038F, 0.01F, 0.01F}, 2e-3F);
    EXPECT_TRUE(mentions(bytes.report.repairs, "0 to 255"));
}

// Levels of the normal along a row of the twelve-sided column.
std::size_t levels(const Scene& scene) {
    std::set<int> found;
    for (float x = -0.98F; x < 0.99F; x += 0.02F) {
        if (const auto point = surface_at(scene, x, 0.1F))
            found.insert(static_cast<int>(std::lround(point->shading.normal.x * 1000)));
    }
    return found.size();
}

TEST(ObjCases, SmoothingGroups) {
    EXPECT_LE(levels(geometry("s_off.obj")), 7U);
    EXPECT_GE(levels(geometry("s_off.obj")), 6U);
    EXPECT_GT(levels(geometry("s_1.obj")), 50U);
    EXPECT_GT(levels(geometry("s_none.obj")), 50U);      // edges of 30°
    EXPECT_GT(levels(geometry("s_1_square.obj")), 50U);  // a group is smooth at 90°, too
}

TEST(ObjCases, RoughnessAndMetalMakeMetal) {
    const Scene scene = geometry("pbr.obj");
    const Material& material = scene.materials[scene.meshes[0].material];
    EXPECT_EQ(material.model, BsdfModel::ggx);
    EXPECT_FLOAT_EQ(material.metallic, 1);
    EXPECT_FLOAT_EQ(material.roughness, 0.2F);
    const Scene maps = geometry("mapns.obj");
    const Material& mapped = maps.materials[maps.meshes[0].material];
    EXPECT_EQ(mapped.model, BsdfModel::ggx);
    EXPECT_TRUE(mapped.surface_texture.has_value());
}

TEST(ObjCases, NormalMapsMasksAndWhatIsNotLit) {
    const Scene norm = geometry("norm.obj");
    EXPECT_TRUE(norm.materials[norm.meshes[0].material].normal_texture.has_value());
    EXPECT_TRUE(geometry("mapd.obj").materials[0].has_holes());
    EXPECT_TRUE(mentions(geometry("d.obj").report.unused, "transparency"));
    EXPECT_TRUE(mentions(geometry("tr.obj").report.unused, "transparency"));
    EXPECT_TRUE(mentions(geometry("ke.obj").report.unused, "emission"));
    const Scene blender = geometry("blender.obj");
    EXPECT_TRUE(blender.report.unused.empty()) << blender.report.unused[0];
    EXPECT_EQ(blender.materials[0].model, BsdfModel::phong);
    EXPECT_FLOAT_EQ(blender.materials[0].exponent, 250);
}

}  // namespace
}  // namespace relume::scene
