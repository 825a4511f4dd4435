// Vertices and triangles of glTF in every form that they are written in.
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_import_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace relume::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;

class GltfGeometry : public test::GltfImport {};

void expect_near(const Imath::V3f& a, const Imath::V3f& b, float tolerance = 1e-5F) {
    EXPECT_LT((a - b).length(), tolerance) << a << " and " << b;
}

// A unit square in z = 0 as four vertices.
const std::vector<Imath::V3f> kSquare{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

Imath::V3f face_normal(const Mesh& mesh, std::size_t t) {
    const Imath::V3f& p = mesh.positions[mesh.triangles[t][0]];
    return (mesh.positions[mesh.triangles[t][1]] - p)
        .cross(mesh.positions[mesh.triangles[t][2]] - p)
        .normalized();
}

TEST_F(GltfGeometry, StripsFansAndListsWithoutIndicesAreWoundAlike) {
    GltfBuilder strip(test::gltf_document(kSquare, {0, 1, 2, 3}));
    strip.primitive()["mode"] = 5;
    GltfBuilder fan(test::gltf_document(kSquare, {0, 1, 3, 2}));
    fan.primitive()["mode"] = 6;
    GltfBuilder bare(test::gltf_document(
        {kSquare[0], kSquare[1], kSquare[2], kSquare[1], kSquare[3], kSquare[2]}, {0}));
    bare.primitive().erase("indices");
    for (const GltfBuilder& builder : {strip, fan, bare}) {
        const Scene scene = import(builder);
        ASSERT_EQ(scene.triangle_count(), 2U);
        expect_near(face_normal(scene.meshes[0], 0), {0, 0, 1});
        expect_near(face_normal(scene.meshes[0], 1), {0, 0, 1});
        expect_near(scene.bounds().max, {1, 1, 0});
    }
}

TEST_F(GltfGeometry, PointsAndLinesAreNamedAndLooseIndicesDropped) {
    GltfBuilder builder(test::gltf_document(kSquare, {0, 1, 2, 3, 0}));
    json lines = builder.primitive();
    lines["mode"] = 1;
    builder.document["meshes"][0]["primitives"].push_back(lines);
    const Scene scene = import(builder);
    EXPECT_EQ(scene.triangle_count(), 1U);
    EXPECT_TRUE(test::mentions(scene.report.unused, "5 vertices of points and lines"));
    EXPECT_TRUE(test::mentions(scene.report.repairs, "2 indices"));
}

TEST_F(GltfGeometry, IntegersAreWhatTheirTypeSays) {
    GltfBuilder builder(test::gltf_triangle());
    // Positions: shorts, four to an element's stride of eight bytes.
    const std::vector<std::array<std::int16_t, 4>> positions{
        {{-32767, 0, 0, 9}}, {{32767, 0, 0, 9}}, {{0, 16384, -32768, 9}}};
    const std::size_t view = builder.view(GltfBuilder::bytes_of(positions));
    builder.document["bufferViews"][view]["byteStride"] = 8;
    const std::size_t accessor = builder.accessor(view, test::kShort, 3, "VEC3", true);
    builder.document["accessors"][accessor]["min"] = {5, 5, 5};  // not trusted
    builder.document["accessors"][accessor]["max"] = {6, 6, 6};
    builder.attributes()["POSITION"] = accessor;
    const std::vector<std::array<std::int8_t, 4>> normals(3, {{0, 0, 127, 0}});
    builder.attributes()["NORMAL"] = [&] {
        const std::size_t of_normals = builder.view(GltfBuilder::bytes_of(normals));
        builder.document["bufferViews"][of_normals]["byteStride"] = 4;
        return builder.accessor(of_normals, test::kByte, 3, "VEC3", true);
    }();
    const std::vector<std::array<std::uint16_t, 4>> colours(3, {{65535, 13107, 0, 32768}});
    builder.attributes()["COLOR_0"] =
        builder.accessor_of(colours, test::kUnsignedShort, "VEC4", true);
    builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = import(builder);
    const Mesh& mesh = scene.meshes[0];
    expect_near(test::world_position(scene, 0, 0), {-1, 0, 0});
    expect_near(test::world_position(scene, 0, 1), {1, 0, 0});
    expect_near(test::world_position(scene, 0, 2), {0, 16384 / 32767.0F, -1});
    expect_near(mesh.normals[0], {0, 0, 1});
    expect_near(mesh.colours[0], {1, 0.2F, 0});
    // The same numbers, not normalized.
    builder.document["accessors"][accessor]["normalized"] = false;
    expect_near(test::world_position(import(builder), 0, 1), {32767, 0, 0}, 1e-2F);
}

TEST_F(GltfGeometry, SparseElementsReplaceOthersAndZeros) {
    for (const bool has_base : {true, false}) {
        GltfBuilder builder(test::gltf_triangle());
        const std::size_t indices =
            builder.view(GltfBuilder::bytes_of(std::vector<std::uint8_t>{1, 2, 0, 0}));
        const std::size_t values =
            builder.view(GltfBuilder::bytes_of(std::vector<Imath::V3f>{{5, 0, 0}, {0, 7, 0}}));
        json& accessor = builder.document["accessors"][0];
        accessor["sparse"] = {{"count", 2},
                              {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                              {"values", {{"bufferView", values}}}};
        if (!has_base)
            accessor.erase("bufferView");
        const Scene scene = import(builder);
        expect_near(scene.bounds().max, {5, 7, 0});
        expect_near(scene.bounds().min, {0, 0, 0});
    }
}

TEST_F(GltfGeometry, OnlyVerticesOfTrianglesAreKept) {
    std::vector<Imath::V3f> many(1000, Imath::V3f(1e6F));
    many[500] = {0, 0, 0};
    many[700] = {1, 0, 0};
    many[999] = {0, 1, 0};
    const Scene scene = import(GltfBuilder(test::gltf_document(many, {500, 700, 999})));
    EXPECT_EQ(scene.vertex_count(), 3U);
    expect_near(scene.bounds().max, {1, 1, 0});
}

TEST_F(GltfGeometry, MorphTargetsAreAppliedByTheirWeights) {
    GltfBuilder builder(test::gltf_triangle());
    const std::size_t up = builder.accessor_of(std::vector<Imath::V3f>(3, Imath::V3f(0, 0, 4)),
                                               test::kFloat, "VEC3");
    const std::size_t aside = builder.accessor_of(
        std::vector<Imath::V3f>(3, Imath::V3f(8, 0, 0)), test::kFloat, "VEC3");
    builder.primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", aside}}};
    builder.document["meshes"][0]["weights"] = {0.5, 0};
    expect_near(import(builder).bounds().min, {0, 0, 2});
    builder.primitive()["targets"][0]["TEXCOORD_0"] = 2;
    EXPECT_TRUE(test::mentions(import(builder).report.unused, "TEXCOORD_0 of morph targets"));
    builder.document["nodes"][0]["weights"] = {0, 0.25};  // the node's own go before the mesh's
    expect_near(import(builder).bounds().min, {2, 0, 0});
}

TEST_F(GltfGeometry, VerticesFollowTheMeanOfTheirJoints) {
    GltfBuilder builder(test::gltf_triangle());
    const std::vector<std::array<std::uint8_t, 4>> joints(3, {{0, 1, 0, 0}});
    const std::vector<std::array<std::uint8_t, 4>> weights(3, {{64, 191, 0, 0}});
    builder.attributes()["JOINTS_0"] = builder.accessor_of(joints, test::kUnsignedByte, "VEC4");
    builder.attributes()["WEIGHTS_0"] =
        builder.accessor_of(weights, test::kUnsignedByte, "VEC4", true);
    builder.document["skins"] = {{{"joints", {2, 3}}}};
    builder.document["nodes"][0]["skin"] = 0;
    builder.document["nodes"][0]["translation"] = {1000, 0, 0};  // ignored
    builder.document["nodes"].push_back({{"translation", {0, 0, 0}}});
    builder.document["nodes"].push_back({{"translation", {0, 0, 255}}});
    builder.document["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = import(builder);
    expect_near(scene.bounds().min, {0, 0, 191}, 1e-3F);
    expect_near(scene.bounds().max, {1, 1, 191}, 1e-3F);
}

// Turned by 90° about Z, scaled by two, moved, in this order; then the node's own map.
TEST_F(GltfGeometry, InstancesAreTurnedScaledAndMoved) {
    GltfBuilder builder(test::gltf_triangle());
    const auto half = static_cast<float>(std::sqrt(0.5));
    const std::size_t translations =
        builder.accessor_of(std::vector<Imath::V3f>{{3, 0, 0}}, test::kFloat, "VEC3");
    const std::size_t rotations = builder.accessor_of(
        std::vector<std::array<float, 4>>{{{0, 0, half, half}}}, test::kFloat, "VEC4");
    const std::size_t scales =
        builder.accessor_of(std::vector<Imath::V3f>{{2, 2, 2}}, test::kFloat, "VEC3");
    builder.document["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing",
         {{"attributes",
           {{"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}}}}}};
    builder.document["nodes"][0]["scale"] = {10, 10, 10};
    const Scene scene = import(builder);
    // (1, 0) → (0, 2) → (3, 2); (0, 1) → (−2, 0) → (1, 0).
    expect_near(scene.bounds().min, {10, 0, 0}, 1e-4F);
    expect_near(scene.bounds().max, {30, 20, 0}, 1e-4F);
}

// A rotation written as a matrix, column by column, and as a quaternion is one rotation.
TEST_F(GltfGeometry, MatricesAndQuaternionsAgree) {
    GltfBuilder turned(test::gltf_triangle());
    const double c = std::cos(0.3);
    const double s = std::sin(0.3);
    turned.document["nodes"][0]["matrix"] = {c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1};
    GltfBuilder quaternion(test::gltf_triangle());
    quaternion.document["nodes"][0]["rotation"] = {0, 0, std::sin(0.15), std::cos(0.15)};
    quaternion.document["nodes"][0]["translation"] = {4, 5, 6};
    const Scene a = import(turned);
    const Scene b = import(quaternion);
    for (std::size_t i = 0; i < 3; ++i)
        expect_near(test::world_position(a, 0, i), test::world_position(b, 0, i), 1e-5F);
    expect_near(test::world_position(a, 0, 1),
                {static_cast<float>(4 + c), static_cast<float>(5 + s), 6}, 1e-5F);
}

TEST_F(GltfGeometry, MirroredNodesKeepTheirOutside) {
    GltfBuilder builder(test::gltf_triangle());
    builder.document["nodes"][0]["scale"] = {-2, 1, 1};
    expect_near(face_normal(import(builder).meshes[0], 0), {0, 0, 1});
}

// Double precision up to the very end: two triangles a metre apart at map coordinates.
TEST_F(GltfGeometry, NodesAddUpInDoublePrecision) {
    GltfBuilder builder(test::gltf_triangle());
    builder.document["nodes"].push_back(
        {{"children", {0}}, {"translation", {123456789.25, 0, 0}}});
    builder.document["nodes"][0]["translation"] = {-123456788.75, 0, 0};
    builder.document["scenes"][0]["nodes"] = {1, 2};
    expect_near(import(builder).bounds().min, {0.5F, 0, 0});
}

TEST_F(GltfGeometry, FlatMeshesDoNotUseTangents) {
    GltfBuilder builder(test::gltf_triangle());
    test::write_red_green(scratch_.path() / "n.png");
    builder.document["images"] = {{{"uri", "n.png"}}};
    builder.document["textures"] = {{{"source", 0}}};
    builder.document["materials"][0]["normalTexture"] = {{"index", 0}};
    builder.attributes()["TANGENT"] = builder.accessor_of(
        std::vector<std::array<float, 4>>(3, {{0, 0, 1, 1}}), test::kFloat, "VEC4");
    const Mesh mesh = import(builder).meshes[0];
    ASSERT_EQ(mesh.tangents.size(), 3U);
    // v grows downwards in the file, along +Y here: the texture's up is −Y.
    EXPECT_EQ(mesh.tangents[0], Imath::V4f(1, 0, 0, -1));
    // With normals the file's own are kept.
    builder.attributes()["NORMAL"] = builder.accessor_of(
        std::vector<Imath::V3f>(3, Imath::V3f(0, 0, 1)), test::kFloat, "VEC3");
    builder.attributes()["TANGENT"] = builder.accessor_of(
        std::vector<std::array<float, 4>>(3, {{0, 1, 0, -1}}), test::kFloat, "VEC4");
    EXPECT_EQ(import(builder).meshes[0].tangents[0], Imath::V4f(0, 1, 0, -1));
}

}  // namespace
}  // namespace relume::scene
