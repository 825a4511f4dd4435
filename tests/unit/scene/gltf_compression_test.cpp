// Compressed glTF, packed here by the encoders of Draco and meshoptimizer: the mesh comes back.
#include "tests/support/reference_tracer/random.h"
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_import_fixture.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace relume::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;

class Draco : public test::GltfImport {};

void expect_near(const Imath::V3f& a, const Imath::V3f& b, float tolerance = 1e-4F) {
    EXPECT_LT((a - b).length(), tolerance) << a << " and " << b;
}

TEST_F(Draco, GivesTheMeshBack) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(2);
    const int position =
        soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int colour = soup.AddAttribute(draco::GeometryAttribute::COLOR, 3, draco::DT_UINT8);
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const std::uint8_t orange[3] = {255, 51, 0};
    const int faces[2][3] = {{0, 1, 2}, {1, 3, 2}};
    for (int f = 0; f < 2; ++f) {
        soup.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<unsigned>(f)),
                                       corners[faces[f][0]], corners[faces[f][1]],
                                       corners[faces[f][2]]);
        soup.SetAttributeValuesForFace(colour, draco::FaceIndex(static_cast<unsigned>(f)),
                                       orange, orange, orange);
    }
    const auto mesh = soup.Finalize();
    const auto position_id = mesh->attribute(position)->unique_id();
    const auto colour_id = mesh->attribute(colour)->unique_id();
    draco::EncoderBuffer packed;
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &packed).ok());

    GltfBuilder builder(test::gltf_triangle());
    const std::vector<std::uint8_t> bytes(packed.data(), packed.data() + packed.size());
    const std::size_t view = builder.view(bytes);
    // Accessors of a Draco primitive need no buffer views.
    builder.document["accessors"] = {
        {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}},
        {{"componentType", 5121}, {"count", 4}, {"type", "VEC3"}, {"normalized", true}}};
    builder.primitive() = {
        {"attributes", {{"POSITION", 0}, {"COLOR_0", 2}}},
        {"indices", 1},
        {"material", 0},
        {"extensions",
         {{"KHR_draco_mesh_compression",
           {{"bufferView", view},
            {"attributes", {{"POSITION", position_id}, {"COLOR_0", colour_id}}}}}}}};
    builder.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const Scene scene = import(builder);
    EXPECT_EQ(scene.triangle_count(), 2U);
    expect_near(scene.bounds().max, {1, 1, 0}, 1e-3F);
    expect_near(scene.meshes[0].colours[0], {1, 0.2F, 0});
    EXPECT_TRUE(test::surface_at(scene, 0.9F, 0.9F));
    GltfBuilder strip = builder;
    strip.primitive()["mode"] = 5;  // its triangles are whole all the same
    EXPECT_EQ(import(strip).triangle_count(), 2U);
    // Changed anywhere, it is another mesh or none.
    reference::Random random(3);
    for (std::size_t i = 0; i < 300; ++i) {
        std::vector<std::uint8_t> changed = bytes;
        changed[i % bytes.size()] = static_cast<std::uint8_t>(256 * random.uniform());
        GltfBuilder other = builder;
        other.document["bufferViews"][view]["buffer"] = other.buffer(changed);
        test::write_json(scratch_.path() / "changed.gltf", other.document);
        try {
            EXPECT_GT(import_scene(scratch_.path() / "changed.gltf").triangle_count(), 0U);
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()), "");
        }
    }
    // Cut short, it is refused.
    for (const std::size_t length : {std::size_t{0}, std::size_t{5}, bytes.size() / 2}) {
        GltfBuilder cut = builder;
        cut.document["bufferViews"][view]["byteLength"] = length;
        EXPECT_NE(refusal(cut, SceneFault::corrupt_file).find("draco"), std::string::npos);
    }
}

// The triangle's positions and indices as meshoptimizer packs them.
class Meshopt : public test::GltfImport {
  protected:
    struct Packed {
        std::vector<std::uint8_t> bytes;
        std::size_t stride;
        std::size_t count;
        std::string mode;
        std::string filter;
    };
    template <typename Element>
    static Packed vertices(const std::vector<Element>& elements, const char* filter = "NONE") {
        Packed packed{{}, sizeof(Element), elements.size(), "ATTRIBUTES", filter};
        packed.bytes.resize(meshopt_encodeVertexBufferBound(elements.size(), sizeof(Element)));
        packed.bytes.resize(meshopt_encodeVertexBuffer(packed.bytes.data(), packed.bytes.size(),
                                                       elements.data(), elements.size(),
                                                       sizeof(Element)));
        return packed;
    }
    // A view whose own buffer is a fallback without bytes.
    static std::size_t add_view(GltfBuilder& builder, const Packed& packed) {
        const std::size_t from = builder.buffer(packed.bytes);
        const std::size_t length = packed.stride * packed.count;
        builder.document["buffers"].push_back(
            {{"byteLength", length},
             {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
        builder.document["bufferViews"].push_back(
            {{"buffer", builder.document["buffers"].size() - 1},
             {"byteLength", length},
             {"extensions",
              {{"EXT_meshopt_compression",
                {{"buffer", from},
                 {"byteLength", packed.bytes.size()},
                 {"byteStride", packed.stride},
                 {"count", packed.count},
                 {"mode", packed.mode},
                 {"filter", packed.filter}}}}}});
        return builder.document["bufferViews"].size() - 1;
    }
};

const std::vector<Imath::V3f> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
const std::vector<std::uint32_t> kFaces{0, 1, 2, 2, 1, 3};

TEST_F(Meshopt, AttributesTrianglesAndIndices) {
    for (const bool are_triangles : {true, false}) {
        GltfBuilder builder(test::gltf_triangle());
        builder.attributes() = {
            {"POSITION",
             builder.accessor(add_view(builder, vertices(kCorners)), test::kFloat, 4, "VEC3")}};
        Packed faces{{}, 4, kFaces.size(), are_triangles ? "TRIANGLES" : "INDICES", "NONE"};
        faces.bytes.resize(256);
        faces.bytes.resize(
            are_triangles ? meshopt_encodeIndexBuffer(faces.bytes.data(), faces.bytes.size(),
                                                      kFaces.data(), kFaces.size())
                          : meshopt_encodeIndexSequence(faces.bytes.data(), faces.bytes.size(),
                                                        kFaces.data(), kFaces.size()));
        builder.primitive()["indices"] =
            builder.accessor(add_view(builder, faces), test::kUnsignedInt, 6, "SCALAR");
        builder.document["extensionsRequired"] = {"EXT_meshopt_compression"};
        const Scene scene = import(builder);
        EXPECT_EQ(scene.triangle_count(), 2U);
        expect_near(scene.bounds().max, {1, 1, 0});
        EXPECT_TRUE(test::surface_at(scene, 0.9F, 0.9F));
    }
}

TEST_F(Meshopt, Filters) {
    // Exponential: positions as 24 bits of mantissa.
    std::vector<std::array<std::uint32_t, 3>> positions(4);
    meshopt_encodeFilterExp(positions.data(), 4, 12, 15, &kCorners[0].x);
    // Octahedral: normals as bytes.
    const std::vector<std::array<float, 4>> up(4, {{0.6F, 0, 0.8F, 0}});
    std::vector<std::array<std::int8_t, 4>> normals(4);
    meshopt_encodeFilterOct(normals.data(), 4, 4, 8, up[0].data());
    GltfBuilder builder(test::gltf_document(kCorners, {0, 1, 2, 2, 1, 3}));
    builder.attributes()["POSITION"] = builder.accessor(
        add_view(builder, vertices(positions, "EXPONENTIAL")), test::kFloat, 4, "VEC3");
    const std::size_t view = add_view(builder, vertices(normals, "OCTAHEDRAL"));
    builder.document["bufferViews"][view]["byteStride"] = 4;
    builder.attributes()["NORMAL"] = builder.accessor(view, test::kByte, 4, "VEC3", true);
    const Scene scene = import(builder);
    expect_near(scene.bounds().max, {1, 1, 0}, 1e-3F);
    expect_near(scene.meshes[0].normals[0], {0.6F, 0, 0.8F}, 0.02F);
}

// Quaternions of an instance: a quarter turn about Z, as shorts.
TEST_F(Meshopt, QuaternionsTurnInstances) {
    const auto half = static_cast<float>(std::sqrt(0.5));
    const std::vector<std::array<float, 4>> turn(4, {{0, 0, half, half}});
    std::vector<std::array<std::int16_t, 4>> packed(4);
    meshopt_encodeFilterQuat(packed.data(), 4, 8, 12, turn[0].data());
    GltfBuilder builder(test::gltf_triangle());
    const std::size_t rotations = builder.accessor(
        add_view(builder, vertices(packed, "QUATERNION")), test::kShort, 4, "VEC4", true);
    builder.document["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", rotations}}}}}};
    const Scene scene = import(builder);
    EXPECT_EQ(scene.triangle_count(), 4U);
    expect_near(scene.bounds().min, {-1, 0, 0}, 2e-3F);
    expect_near(scene.bounds().max, {0, 1, 0}, 2e-3F);
}

TEST_F(Meshopt, WhatCannotBeUnpackedIsRefused) {
    const auto refused = [&](const auto& change) {
        GltfBuilder builder(test::gltf_triangle());
        const std::size_t view = add_view(builder, vertices(kCorners));
        builder.attributes()["POSITION"] = builder.accessor(view, test::kFloat, 4, "VEC3");
        json& self = builder.document["bufferViews"][view];
        change(self, self["extensions"]["EXT_meshopt_compression"]);
        EXPECT_NE(refusal(builder, SceneFault::corrupt_file).find("buffer view"),
                  std::string::npos);
    };
    refused([](json& /*view*/, json& packed) { packed["mode"] = "GUESS"; });
    refused([](json& /*view*/, json& packed) { packed["filter"] = "SEPIA"; });
    refused([](json& /*view*/, json& packed) { packed["byteStride"] = 13; });
    refused([](json& /*view*/, json& packed) { packed["byteLength"] = 3; });
    refused([](json& /*view*/, json& packed) { packed["byteLength"] = 1000000; });
    refused([](json& /*view*/, json& packed) { packed.erase("count"); });
    refused([](json& view, json& packed) {  // more than such bytes can hold
        packed["count"] = 100000000;
        view["byteLength"] = 1200000000;
    });
    refused([](json& view, json& /*packed*/) { view["byteLength"] = 47; });
    // Without the extension the fallback is asked for its bytes, and has none.
    refused([](json& view, json& /*packed*/) { view["byteLength"] = 49; });
    GltfBuilder builder(test::gltf_triangle());
    const std::size_t view = add_view(builder, vertices(kCorners));
    builder.attributes()["POSITION"] = builder.accessor(view, test::kFloat, 4, "VEC3");
    builder.document["bufferViews"][view].erase("extensions");
    EXPECT_NE(refusal(builder, SceneFault::corrupt_file).find("has no bytes"),
              std::string::npos);
}

}  // namespace
}  // namespace relume::scene
