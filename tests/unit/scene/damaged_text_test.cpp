// OBJ, MTL and PLY files with bytes changed or cut off: read or refused, never more.
#include "precompute/scene/error.h"
#include "precompute/scene/import.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

std::string text_of(const std::string& name) {
    const std::vector<std::uint8_t> bytes = test::read_bytes(test::case_path(name));
    return {bytes.begin(), bytes.end()};
}

// What a scene must satisfy to be baked, where the file is not refused.
void expect_read_or_refused(const std::filesystem::path& path) {
    try {
        ImportOptions options;
        options.max_triangles = 10'000;
        const Scene scene = import_scene(path, options);
        RC_ASSERT(scene.triangle_count() > 0U);
        for (const Mesh& mesh : scene.meshes) {
            RC_ASSERT(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
            for (const Imath::V3f& p : mesh.positions)
                RC_ASSERT(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
            for (const Triangle& triangle : mesh.triangles) {
                for (const std::uint32_t index : triangle)
                    RC_ASSERT(index < mesh.positions.size());
            }
        }
    } catch (const SceneError&) {
        // Named what was found and what was expected.
    }
}

void damage(std::string& text) {
    const auto changes = *rc::gen::inRange(0, 4);
    for (int i = 0; i < changes && !text.empty(); ++i)
        text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
    if (*rc::gen::inRange(0, 3) == 0)
        text.resize(*rc::gen::inRange<std::size_t>(0, text.size() + 1));
}

void damage_and_read(const char* name, const char* file) {
    const test::ScratchDirectory scratch;
    std::string text = text_of(name);
    damage(text);
    test::write_text(scratch.path() / file, text);
    expect_read_or_refused(scratch.path() / file);
}

RC_GTEST_PROP(DamagedText, Obj, ()) {
    const auto* name =
        *rc::gen::element("21-obj-geometry/star.obj", "21-obj-geometry/keyhole.obj",
                          "21-obj-geometry/vcol.obj", "21-obj-geometry/neg_interleaved.obj",
                          "21-obj-geometry/s_1_square.obj", "20-obj-mtl-names/cont.obj");
    damage_and_read(name, "scene.obj");
}

RC_GTEST_PROP(DamagedText, Mtl, ()) {
    const test::ScratchDirectory scratch;
    const auto* name = *rc::gen::element(
        "20-obj-mtl-names/opts_mix.mtl", "21-obj-geometry/mapns.mtl", "21-obj-geometry/pbr.mtl",
        "20-obj-mtl-names/winabs.mtl", "22-obj-non-utf8-names/gbk_gloss.mtl");
    std::string text = text_of(name);
    damage(text);
    test::write_text(scratch.path() / "plain.mtl", text);
    test::write_text(scratch.path() / "scene.obj", text_of("20-obj-mtl-names/plain.obj"));
    expect_read_or_refused(scratch.path() / "scene.obj");
}

RC_GTEST_PROP(DamagedText, Ply, ()) {
    const auto* name = *rc::gen::element(
        "23-ply/ascii.ply", "23-ply/le_face_extra.ply", "23-ply/be_uint_double.ply",
        "23-ply/le_tristrips.ply", "23-ply/strip_ribbon.ply", "23-ply/le_vertex_extra.ply");
    damage_and_read(name, "scene.ply");
}

// Every cut of a small file.
TEST(DamagedText, EveryCutIsReadOrRefused) {
    const test::ScratchDirectory scratch;
    for (const char* name :
         {"23-ply/le_tristrips.ply", "21-obj-geometry/neg_interleaved.obj"}) {
        const std::string whole = text_of(name);
        const auto path = scratch.path() / std::filesystem::path(name).filename();
        for (std::size_t size = 0; size < whole.size(); ++size) {
            test::write_text(path, whole.substr(0, size));
            EXPECT_NO_THROW(expect_read_or_refused(path)) << name << " cut at " << size;
        }
    }
}

}  // namespace
}  // namespace relume::scene
