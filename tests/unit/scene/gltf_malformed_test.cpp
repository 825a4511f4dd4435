// Documents that lie about themselves are refused with the item's number and what was expected;
// no bytes whatever end the program or make it hold more than they can fill.
#include "precompute/scene/error.h"
#include "precompute/scene/import.h"
#include "tests/support/reference_tracer/random.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;

class GltfMalformed : public testing::Test {
  protected:
    // "" where it was imported.
    std::string refusal(const json& document) { return refusal_of(document.dump()); }
    std::string refusal_of(const std::string& text, const char* name = "scene.gltf") {
        test::write_text(scratch_.path() / name, text);
        try {
            (void)import_scene(scratch_.path() / name);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    }
    void expect_refused(const std::function<void(json&)>& change, const std::string& words) {
        json document = test::gltf_triangle();
        change(document);
        const std::string why = refusal(document);
        EXPECT_NE(why.find(words), std::string::npos) << words << " in: " << why;
    }
    test::ScratchDirectory scratch_;
};

TEST_F(GltfMalformed, IndicesOfEveryKindAreChecked) {
    const auto set = [](const char* pointer, const json& value) {
        return [=](json& document) { document[json::json_pointer(pointer)] = value; };
    };
    expect_refused(set("/scene", 7), "the document refers to scene 7; expected below 1");
    expect_refused(set("/scenes/0/nodes/0", 9), "scene 0 refers to node 9; expected below 2");
    expect_refused(set("/nodes/0/children", {-4}), "node 0 refers to node -4");
    expect_refused(set("/nodes/0/mesh", 5), "refers to mesh 5; expected below 1");
    expect_refused(set("/nodes/1/camera", 5), "refers to camera 5; expected below 1");
    expect_refused(set("/nodes/0/skin", 0), "refers to skin 0; expected below 0");
    expect_refused(set("/meshes/0/primitives/0/material", 3),
                   "primitive 0 of mesh 0 'shape' refers to material 3; expected below 1");
    expect_refused(set("/meshes/0/primitives/0/attributes/POSITION", 99),
                   "refers to accessor 99; expected below 3");
    expect_refused(set("/accessors/0/bufferView", 44), "refers to buffer view 44");
    expect_refused(set("/bufferViews/0/buffer", 6), "buffer view 0 refers to buffer 6");
    expect_refused(set("/materials/0/pbrMetallicRoughness/baseColorTexture", {{"index", 2}}),
                   "material 'stuff' refers to texture 2; expected below 0");
}

TEST_F(GltfMalformed, RangesOfEveryKindAreChecked) {
    const auto set = [](const char* pointer, const json& value) {
        return [=](json& document) { document[json::json_pointer(pointer)] = value; };
    };
    expect_refused(set("/accessors/0/count", 4), "expected at most 3");
    expect_refused(set("/accessors/0/count", 4000000000000000000ULL), "expected at most 3");
    expect_refused(set("/accessors/0/byteOffset", 18446744073709551615ULL),
                   "expected at most 0");
    expect_refused(set("/accessors/0/count", 0), "no elements");
    expect_refused(set("/accessors/0/componentType", 5124), "componentType 5124");
    expect_refused(set("/accessors/0/type", "VEC2"), "elements of 2 numbers; expected 3");
    expect_refused(set("/bufferViews/0/byteLength", 100000), "buffer view 0 is 100000 bytes");
    expect_refused(set("/bufferViews/0/byteOffset", 18446744073709551615ULL),
                   "buffer view 0 is 36 bytes at 18446744073709551615");
    expect_refused(set("/bufferViews/0/byteStride", 4), "12 bytes, 4 apart");
    expect_refused(set("/buffers/0/byteLength", 1000000), "expected 1000000");
    expect_refused(set("/buffers/0/byteLength", -1), "buffer 0 has no byteLength");
    expect_refused(set("/buffers/0/uri", "data:text/plain;base64,!!"), "is no base64");
    expect_refused(set("/buffers/0/uri", "nowhere.bin"), "no file 'nowhere.bin'");
    expect_refused(set("/buffers/0/uri", "../../../etc/passwd"), "no file");
    expect_refused(set("/nodes/0/matrix", {1, 2, 3}), "matrix has 3 numbers; expected 16");
    expect_refused(set("/nodes/0/rotation", {1, 2, 3}), "rotation has 3 numbers; expected 4");
    expect_refused(set("/meshes/0/primitives/0/mode", 9), "mode 9; expected 0 to 6");
    expect_refused(set("/asset/version", "1.0"), "glTF version '1.0'; expected 2.x");
    // Zeros without bytes are bounded as well.
    expect_refused(
        [](json& document) {
            document["accessors"][0].erase("bufferView");
            document["accessors"][0]["count"] = 4000000000U;
        },
        "without a buffer view");
}

TEST_F(GltfMalformed, SparseElementsAreChecked) {
    const auto sparse = [&](const std::vector<std::uint8_t>& indices, int count,
                            const std::string& words) {
        GltfBuilder builder(test::gltf_triangle());
        const std::size_t of_indices = builder.view(indices);
        const std::size_t of_values =
            builder.view(GltfBuilder::bytes_of(std::vector<Imath::V3f>(2)));
        builder.document["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", of_indices}, {"componentType", 5121}}},
            {"values", {{"bufferView", of_values}}}};
        const std::string why = refusal(builder.document);
        EXPECT_NE(why.find(words), std::string::npos) << why;
    };
    sparse({2, 1}, 2, "index 1 is 1; expected ascending ones below 3");
    sparse({1, 3}, 2, "index 1 is 3; expected ascending ones below 3");
    sparse({0, 1, 2}, 3, "3 elements of 12 bytes");
    sparse({0}, 2, "2 elements of 1 bytes");
    sparse({0, 1}, 4, "4 of 3 elements");
    sparse({0, 1}, -1, "-1 of 3 elements");
}

TEST_F(GltfMalformed, NodesFormTrees) {
    expect_refused([](json& d) { d["nodes"][0]["children"] = {0}; }, "its own ancestor");
    expect_refused(
        [](json& d) {
            d["nodes"][0]["children"] = {1};
            d["nodes"][1]["children"] = {0};
        },
        "its own ancestor");
    expect_refused(
        [](json& d) {
            d["nodes"].push_back({{"children", {1}}});
            d["nodes"].push_back({{"children", {1}}});
        },
        "node 1 is a child of node 2 and of node 3");
    // A long chain is no fault, and no recursion.
    json document = test::gltf_triangle();
    for (int i = 0; i < 20000; ++i)
        document["nodes"].push_back({{"children", {i == 0 ? 0 : i + 1}}});
    document["scenes"][0]["nodes"] = {20001, 1};
    EXPECT_EQ(refusal(document), "");
}

TEST_F(GltfMalformed, DeepOrBrokenJson) {
    std::string deep = R"({"asset":{"version":"2.0"},"extras":)";
    deep += std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_NE(refusal_of(deep).find("more than 64 levels"), std::string::npos);
    EXPECT_NE(refusal_of("[1]").find("no object"), std::string::npos);
    EXPECT_NE(refusal_of(R"({"asset":{"version":"2.0"}})").find("no triangles"),
              std::string::npos);
    EXPECT_NE(refusal_of(R"({"buffers":3,"asset":{"version":"2.0"}})").find("'buffers'"),
              std::string::npos);
}

TEST_F(GltfMalformed, InstancesAreBounded) {
    GltfBuilder builder(test::gltf_triangle());
    builder.document["accessors"].push_back(
        {{"componentType", 5126}, {"count", 9000000}, {"type", "VEC3"}});
    builder.document["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing",
         {{"attributes", {{"TRANSLATION", builder.document["accessors"].size() - 1}}}}}};
    EXPECT_NE(refusal(builder.document).find("expected at most 1000000"), std::string::npos);
}

// Names and paths in a code page, with control characters, or in no encoding at all.
TEST_F(GltfMalformed, NamesNeverFailAnImport) {
    json document = test::gltf_triangle();
    document["buffers"][0]["uri"] = "MARK.bin";
    document["materials"][0]["name"] = "MARK";
    document["materials"][0]["alphaMode"] = "BLEND";
    document["nodes"][0]["name"] = "MARK";
    document["nodes"][1]["name"] = "MARK";
    std::string text = document.dump();
    const std::string name = "gr\xfcn";
    for (std::size_t at = text.find("MARK"); at != std::string::npos; at = text.find("MARK"))
        text.replace(at, 4, name);
    // The triangle's positions, indices and texture coordinates under that name.
    std::vector<std::uint8_t> bytes =
        GltfBuilder::bytes_of(std::vector<Imath::V3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto indices = GltfBuilder::bytes_of(std::vector<std::uint16_t>{0, 1, 2, 0});
    bytes.insert(bytes.end(), indices.begin(), indices.end());
    bytes.resize(68);
    std::ofstream(scratch_.path() / (name + ".bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    test::write_text(scratch_.path() / "scene.gltf", text);
    const Scene scene = import_scene(scratch_.path() / "scene.gltf");
    EXPECT_EQ(scene.materials[0].name, "gr\\xfcn");
    EXPECT_EQ(scene.camera.name, "gr\\xfcn");
    EXPECT_TRUE(test::mentions(scene.report.unused, "material 'gr\\xfcn'"));
}

TEST_F(GltfMalformed, ContainersAreChecked) {
    const std::string glb = test::glb_triangle();
    for (std::size_t length = 0; length < glb.size(); length += 7)
        EXPECT_NE(refusal_of(glb.substr(0, length), "cut.glb"), "") << length;
    std::string first = glb;
    first[4] = 1;
    EXPECT_NE(refusal_of(first, "old.glb").find("version 1; expected 2"), std::string::npos);
    std::string wild = glb;
    wild[15] = '\x7f';  // the first chunk's length
    EXPECT_NE(refusal_of(wild, "wild.glb").find("a chunk of"), std::string::npos);
    // The form is told by the bytes, not by the name.
    EXPECT_EQ(refusal_of(glb, "named.gltf"), "");
    EXPECT_EQ(refusal_of(test::gltf_triangle().dump(), "named.glb"), "");
}

// Whatever bytes are changed or lost: a scene or a SceneError.
TEST_F(GltfMalformed, ChangedBytesNeverEndTheProgram) {
    std::vector<std::string> seeds{test::glb_triangle(), test::gltf_triangle().dump()};
    for (const char* file :
         {"06-gpu-instancing/instanced.gltf", "11-skinned-scaled-armature/skin_posed.gltf",
          "04-texture-transform/rot90.gltf", "16-material-extensions/specular_colour.gltf"}) {
        const std::filesystem::path path = test::case_path(file);
        const auto bytes = test::read_bytes(path);
        seeds.emplace_back(bytes.begin(), bytes.end());
        for (const auto& entry : std::filesystem::directory_iterator(path.parent_path()))
            std::filesystem::copy(entry.path(), scratch_.path(),
                                  std::filesystem::copy_options::overwrite_existing);
    }
    reference::Random random(11);
    const auto below = [&](std::size_t count) {
        return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
    };
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 1500; ++i) {
        std::string bytes = seeds[below(seeds.size())];
        if (i % 5 == 0)
            bytes.resize(below(bytes.size()));
        for (std::size_t k = 0; k <= below(4) && !bytes.empty(); ++k) {
            // Mostly a digit for a digit, which leaves the JSON whole and changes what it says.
            std::size_t at = below(bytes.size());
            if (i % 4 != 0)
                at = std::min(bytes.find_first_of("0123456789", at), bytes.size() - 1);
            const bool is_digit = bytes[at] >= '0' && bytes[at] <= '9';
            bytes[at] = static_cast<char>(is_digit ? '0' + below(10) : below(256));
        }
        test::write_text(scratch_.path() / "changed.glb", bytes);
        try {
            const Scene scene = import_scene(scratch_.path() / "changed.glb");
            EXPECT_GT(scene.triangle_count(), 0U);
            ++read;
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()), "");
            ++refused;
        }
    }
    EXPECT_GT(read, 50);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace relume::scene
