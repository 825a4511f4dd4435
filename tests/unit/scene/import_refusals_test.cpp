// Every file that is no scene ends in a SceneError of its own kind that names the file.
#include "precompute/scene/error.h"
#include "precompute/scene/import.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>

namespace relume::scene {
namespace {

using nlohmann::json;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class ImportRefusals : public testing::Test {
  protected:
    void expect_fault(const std::string& file,
                      SceneFault fault,
                      const ImportOptions& options = {}) {
        try {
            (void)import_scene(scratch_.path() / file, options);
            ADD_FAILURE() << file << " was imported";
        } catch (const SceneError& error) {
            EXPECT_EQ(error.fault(), fault) << error.what();
            const std::string stem = file.substr(0, file.find('.'));
            EXPECT_NE(std::string(error.what()).find(stem), std::string::npos) << error.what();
        }
    }
    void write(const std::string& file, const std::string& text) {
        test::write_text(scratch_.path() / file, text);
    }
    void write(const std::string& file, const json& document) {
        test::write_json(scratch_.path() / file, document);
    }
    test::ScratchDirectory scratch_;
};

ImportOptions with_camera() {
    ImportOptions options;
    options.camera = {.eye = Imath::V3d(0, 0, 4), .look_at = Imath::V3d(0, 0, 0)};
    return options;
}

TEST_F(ImportRefusals, MissingFile) {
    expect_fault("nowhere.gltf", SceneFault::missing_file);
}

TEST_F(ImportRefusals, FolderInsteadOfFile) {
    std::filesystem::create_directory(scratch_.path() / "folder.obj");
    expect_fault("folder.obj", SceneFault::missing_file);
}

TEST_F(ImportRefusals, UnsupportedFormat) {
    write("model.fbx", std::string("Kaydara FBX Binary"));
    expect_fault("model.fbx", SceneFault::unsupported_format);
    write("model", std::string("x"));
    expect_fault("model", SceneFault::unsupported_format);
}

TEST_F(ImportRefusals, CorruptFiles) {
    write("text.gltf", std::string("this is no JSON"));
    expect_fault("text.gltf", SceneFault::corrupt_file);
    write("empty.gltf", std::string());
    expect_fault("empty.gltf", SceneFault::corrupt_file);
    write("binary.glb", std::string("glTF\x02\0\0\0\xff\xff\xff\x7f", 12));
    expect_fault("binary.glb", SceneFault::corrupt_file);
    write("head.ply", std::string("ply\nformat ascii 1.0\nelement vertex"));
    expect_fault("head.ply", SceneFault::corrupt_file, with_camera());
}

TEST_F(ImportRefusals, TruncatedGltfAtEveryEighth) {
    const std::string text = test::gltf_triangle().dump();
    for (std::size_t eighth = 0; eighth < 8; ++eighth) {
        write("cut.gltf", text.substr(0, text.size() * eighth / 8));
        expect_fault("cut.gltf", SceneFault::corrupt_file);
    }
}

TEST_F(ImportRefusals, TruncatedPlyAtEveryByte) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n";
    for (std::size_t length = 0; length < text.size(); ++length) {
        write("cut.ply", text.substr(0, length));
        try {
            // A cut inside a face may leave a smaller scene that is whole.
            EXPECT_LE(import_scene(scratch_.path() / "cut.ply", with_camera()).triangle_count(),
                      2U);
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find("cut"), std::string::npos);
        }
    }
}

TEST_F(ImportRefusals, BufferShorterThanItsAccessors) {
    json document = test::gltf_triangle();
    document["accessors"][0]["count"] = 1000;
    write("short.gltf", document);
    expect_fault("short.gltf", SceneFault::corrupt_file);
}

TEST_F(ImportRefusals, NoGeometry) {
    json document = test::gltf_triangle();
    document.erase("meshes");
    document["nodes"][0].erase("mesh");
    write("bare.gltf", document);
    expect_fault("bare.gltf", SceneFault::no_geometry);
}

TEST_F(ImportRefusals, NothingButPoints) {
    json document = test::gltf_triangle();
    document["meshes"][0]["primitives"][0]["mode"] = 0;
    write("points.gltf", document);
    expect_fault("points.gltf", SceneFault::no_geometry);
    write("cloud.ply",
          std::string("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n"));
    expect_fault("cloud.ply", SceneFault::no_geometry, with_camera());
}

TEST_F(ImportRefusals, VerticesThatAreNoNumbers) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        write("wild.gltf", test::gltf_document({{0, 0, 0}, {1, bad, 0}, {0, 1, 0}}, {0, 1, 2}));
        expect_fault("wild.gltf", SceneFault::non_finite_vertex);
    }
    write("wild.gltf", test::gltf_document({{0, 0, 0}, {1e20F, 0, 0}, {0, 1, 0}}, {0, 1, 2}));
    expect_fault("wild.gltf", SceneFault::non_finite_vertex);
}

TEST_F(ImportRefusals, VerticesThatOverflowByTheirNode) {
    json document = test::gltf_triangle();
    document["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    write("blown.gltf", document);
    expect_fault("blown.gltf", SceneFault::non_finite_vertex);
}

TEST_F(ImportRefusals, AllTrianglesDegenerate) {
    write("flat.gltf",
          test::gltf_document({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2, 0, 0, 1}));
    expect_fault("flat.gltf", SceneFault::all_degenerate);
}

TEST_F(ImportRefusals, IndexOutOfRange) {
    write("beyond.gltf",
          test::gltf_document({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 1, 3}));
    expect_fault("beyond.gltf", SceneFault::index_out_of_range);
    write("beyond.ply",
          std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                      "property float y\nproperty float z\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n"
                      "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"));
    expect_fault("beyond.ply", SceneFault::index_out_of_range, with_camera());
}

TEST_F(ImportRefusals, BrokenTexture) {
    // No PNG at all: at one that is cut short OpenImageIO 2.4 loses a string (libpng jumps over
    // its destructor), which the leak checker would hold against us.
    write("broken.png", std::string("this is no picture"));
    json document = test::gltf_triangle();
    document["images"] = {{{"uri", "broken.png"}}};
    document["textures"] = {{{"source", 0}}};
    document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
    write("broken.gltf", document);
    expect_fault("broken.gltf", SceneFault::bad_texture);
}

TEST_F(ImportRefusals, MoreThanTheBounds) {
    write("large.gltf", test::gltf_triangle());
    ImportOptions options;
    options.max_triangles = 0;
    expect_fault("large.gltf", SceneFault::too_large, options);
    options = {};
    options.max_nodes = 1;
    expect_fault("large.gltf", SceneFault::too_large, options);
    options = {};
    options.max_file_bytes = 100;
    expect_fault("large.gltf", SceneFault::too_large, options);
    test::write_red_green(scratch_.path() / "rg.png");
    json document = test::gltf_triangle();
    document["images"] = {{{"uri", "rg.png"}}};
    document["textures"] = {{{"source", 0}}};
    document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
    write("large.gltf", document);
    options = {};
    options.max_textures = 0;
    expect_fault("large.gltf", SceneFault::too_large, options);
}

}  // namespace
}  // namespace relume::scene
