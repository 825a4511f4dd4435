// The PLY files under tests/cases/scenes, each with the right value that its README states.
#include "precompute/scene/error.h"
#include "precompute/scene/srgb.h"
#include "tests/unit/scene/case_probe.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace relume::scene {
namespace {

using test::colour_at;
using test::expect_quadrants;
using test::import_case;
using test::surface_at;

Scene ply(const std::string& file) {
    return import_case("23-ply/" + file + ".ply");
}

Imath::V3f linear(float r, float g, float b) {
    return {linear_from_srgb(r / 255), linear_from_srgb(g / 255), linear_from_srgb(b / 255)};
}

// The quad from −1.6 to 1.6, whose diagonal runs from its lower left to its upper right corner.
TEST(PlyCases, VertexColoursWhateverTheFileIsWrittenLike) {
    for (const char* file :
         {"ascii", "ascii_crlf", "ascii_quad", "be", "be_uint_double", "le", "le_comments",
          "le_crlf_header", "le_diffuse", "le_face_extra", "le_face_rgb", "le_first_byte_space",
          "le_floatcol", "le_rgba", "le_short_idx", "le_tristrips", "le_typenames",
          "le_ushortcol", "le_vertex_extra"}) {
        SCOPED_TRACE(file);
        const Scene scene = ply(file);
        EXPECT_EQ(scene.triangle_count(), 2U);
        const Imath::V3f corners[4] = {
            colour_at(scene, -1.599F, -1.599F), colour_at(scene, 1.598F, -1.599F),
            colour_at(scene, 1.598F, 1.599F), colour_at(scene, -1.599F, 1.598F)};
        const Imath::V3f expected[4] = {linear(204, 26, 26), linear(26, 204, 26),
                                        linear(26, 26, 204), linear(204, 204, 26)};
        for (int i = 0; i < 4; ++i)
            EXPECT_LT((corners[i] - expected[i]).length(), 0.01F) << i << ' ' << corners[i];
    }
}

TEST(PlyCases, DataMayBeginWithAnyByte) {
    const Scene quad = ply("le_first_byte_lf");
    EXPECT_EQ(quad.triangle_count(), 2U);
    const Scene whole = ply("ball_00");
    const Scene ball = ply("ball_0a");
    ASSERT_EQ(ball.triangle_count(), whole.triangle_count());
    for (const float x : {-0.5F, 0.1F, 0.6F})
        EXPECT_EQ(surface_at(ball, x, 0.2F).has_value(),
                  surface_at(whole, x, 0.2F).has_value());
}

TEST(PlyCases, TextureCoordinatesUnderTheirThreeNames) {
    for (const char* file : {"tex_st", "tex_uv", "tex_uv2"}) {
        SCOPED_TRACE(file);
        expect_quadrants(ply(file));
    }
}

TEST(PlyCases, StripsAndPlainSurfaces) {
    EXPECT_EQ(ply("strip_ribbon").triangle_count(), 20U);
    EXPECT_LT((colour_at(ply("nocolour"), 0.1F, 0) - Imath::V3f(0.5F)).length(), 1e-6F);
}

TEST(PlyCases, PointsAloneAreRefusedInWords) {
    for (const char* file : {"points_only", "zero_faces"}) {
        try {
            (void)ply(file);
            ADD_FAILURE() << file;
        } catch (const SceneError& error) {
            EXPECT_EQ(error.fault(), SceneFault::no_geometry);
            EXPECT_NE(std::string(error.what()).find("4 points and no faces"),
                      std::string::npos)
                << error.what();
        }
    }
}

}  // namespace
}  // namespace relume::scene
