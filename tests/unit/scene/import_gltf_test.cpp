// What a glTF file says and what the bake gets.
#include "precompute/scene/import.h"
#include "precompute/scene/surface_point.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

namespace relume::scene {
namespace {

using nlohmann::json;

class ImportGltf : public testing::Test {
  protected:
    Scene import(const json& document) {
        test::write_json(scratch_.path() / "scene.gltf", document);
        return import_scene(scratch_.path() / "scene.gltf");
    }
    test::ScratchDirectory scratch_;
};

bool mentions(const std::vector<std::string>& lines, const std::string& word) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(word) != std::string::npos;
    });
}

void expect_near(const Imath::V3f& a, const Imath::V3f& b) {
    EXPECT_LT((a - b).length(), 1e-4F) << a << " and " << b;
}

TEST_F(ImportGltf, TriangleMaterialAndCamera) {
    json document = test::gltf_triangle();
    document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {0.2, 0.4, 0.6, 1}},
                                                        {"metallicFactor", 0.25},
                                                        {"roughnessFactor", 0.5}};
    const Scene scene = import(document);
    EXPECT_EQ(scene.name, "scene");
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.triangle_count(), 1U);
    EXPECT_TRUE(scene.meshes[0].normals.empty());  // glTF: flat
    const Material& material = scene.materials[scene.meshes[0].material];
    EXPECT_EQ(material.name, "stuff");
    EXPECT_EQ(material.model, BsdfModel::ggx);
    expect_near(material.base_colour, {0.2F, 0.4F, 0.6F});
    EXPECT_FLOAT_EQ(material.metallic, 0.25F);
    EXPECT_FLOAT_EQ(material.roughness, 0.5F);
    EXPECT_NEAR(scene.camera.vertical_fov_degrees, 40.0F, 1e-3F);
    const Camera camera(scene.camera, 30, 20);
    expect_near(camera.eye(), {0, 0, 0});
    expect_near(Imath::V3f(scene.frame.origin), {0, 0, 5});
    expect_near(camera.forward(), {0, 0, -1});
    expect_near(camera.up(), {0, 1, 0});
    EXPECT_TRUE(scene.report.unused.empty());
}

TEST_F(ImportGltf, DefaultsOfTheFormat) {
    const Scene scene = import(test::gltf_triangle());
    const Material& material = scene.materials[scene.meshes[0].material];
    EXPECT_EQ(material.base_colour, Imath::V3f(1));
    EXPECT_EQ(material.metallic, 1.0F);
    EXPECT_EQ(material.roughness, 1.0F);
    EXPECT_FALSE(material.has_holes());
}

TEST_F(ImportGltf, CameraWithoutAspectAndInsideMovedNodes) {
    json document = test::gltf_triangle();
    document["cameras"][0]["perspective"].erase("aspectRatio");
    const double half = std::sqrt(0.5);
    // A parent turned by +90° about Y: −Z becomes −X; scaled by 2.
    document["nodes"].push_back(
        {{"children", {1}}, {"rotation", {0, half, 0, half}}, {"scale", {2, 2, 2}}});
    document["scenes"][0]["nodes"] = {0, 2};
    const Scene scene = import(document);
    EXPECT_NEAR(scene.camera.vertical_fov_degrees, 40.0F, 1e-3F);
    const Camera camera(scene.camera, 10, 10);
    expect_near(Imath::V3f(scene.frame.origin), {10, 0, 0});
    expect_near(camera.forward(), {-1, 0, 0});
}

TEST_F(ImportGltf, InstancesAreFlattened) {
    json document = test::gltf_triangle();
    document["nodes"].push_back(
        {{"name", "again"}, {"mesh", 0}, {"translation", {3, 0, 0}}, {"scale", {-2, 1, 1}}});
    document["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = import(document);
    ASSERT_EQ(scene.meshes.size(), 2U);
    const Imath::Box3f box = scene.bounds();
    expect_near(box.min, {0, 0, 0});
    expect_near(box.max, {3, 1, 0});
}

TEST_F(ImportGltf, NormalsFollowUnevenScale) {
    json document = test::gltf_document({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, {0, 1, 2});
    // The plane z = y has the normal (0, −1, 1)/√2; three of them as an attribute.
    const float n = std::sqrt(0.5F);
    const Imath::V3f normals[3] = {{0, -n, n}, {0, -n, n}, {0, -n, n}};
    std::vector<std::uint8_t> bytes(sizeof(normals));
    std::memcpy(bytes.data(), normals, sizeof(normals));
    document["buffers"].push_back(
        {{"byteLength", bytes.size()},
         {"uri", "data:application/octet-stream;base64," + test::base64(bytes)}});
    document["bufferViews"].push_back(
        {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
    document["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
    document["nodes"][0]["scale"] = {1, 1, 3};
    const Scene scene = import(document);
    ASSERT_EQ(scene.meshes[0].normals.size(), 3U);
    // The plane is z = 3y now.
    expect_near(scene.meshes[0].normals[0], Imath::V3f(0, -3, 1).normalized());
}

TEST_F(ImportGltf, TexturesBesideEmbeddedAndInTheBuffer) {
    test::write_red_green(scratch_.path() / "red green.png");
    const auto picture = test::read_bytes(scratch_.path() / "red green.png");
    json document = test::gltf_triangle();
    document["textures"] = {{{"source", 0}}};
    document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                                        {"metallicFactor", 0}};
    const json beside = {{"uri", "red%20green.png"}};
    const json inside = {{"uri", "data:image/png;base64," + test::base64(picture)}};
    for (const json& image : {beside, inside}) {
        document["images"] = json::array({image});
        const Scene scene = import(document);
        EXPECT_TRUE(scene.report.unused.empty())
            << (scene.report.unused.empty() ? "" : scene.report.unused[0]);
        ASSERT_EQ(scene.textures.size(), 1U);
        // glTF's v grows downwards, and u = 0 is the left side: red.
        const SurfacePoint left = surface_point(scene, 0, 0, {0.25F, 0.1F}, {0, 0, -1});
        const SurfacePoint right = surface_point(scene, 0, 0, {0.75F, 0.1F}, {0, 0, -1});
        expect_near(left.bsdf.diffuse_colour(), {1, 0, 0});
        expect_near(right.bsdf.diffuse_colour(), {0, 1, 0});
    }
}

TEST_F(ImportGltf, RoughnessAndMetalComeFromTheTextureChannels) {
    test::write_red_green(scratch_.path() / "rg.png");
    json document = test::gltf_triangle();
    document["images"] = {{{"uri", "rg.png"}}};
    document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    document["textures"] = {{{"source", 0}, {"sampler", 0}}};
    document["materials"][0]["pbrMetallicRoughness"] = {
        {"metallicRoughnessTexture", {{"index", 0}}}, {"roughnessFactor", 0.8}};
    const Scene scene = import(document);
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].wrap_u(), Wrap::clamp);
    EXPECT_EQ(scene.textures[0].wrap_v(), Wrap::mirror);
    // Green, right: roughness 0.8·1, metallic 1·0. Red, left: both 0.
    const SurfacePoint right = surface_point(scene, 0, 0, {0.9F, 0.05F}, {0, 0, -1});
    EXPECT_NEAR(right.bsdf.alpha(), 0.64F, 1e-5F);
    EXPECT_EQ(right.bsdf.diffuse_colour(), Imath::V3f(1));
    const SurfacePoint left = surface_point(scene, 0, 0, {0.05F, 0.05F}, {0, 0, -1});
    EXPECT_EQ(left.bsdf.alpha(), Bsdf::kMinRoughness * Bsdf::kMinRoughness);
}

TEST_F(ImportGltf, AlphaModes) {
    json document = test::gltf_triangle();
    document["materials"][0]["alphaMode"] = "MASK";
    document["materials"][0]["alphaCutoff"] = 0.3;
    document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 1, 1, 0.25}}};
    const Scene masked = import(document);
    EXPECT_FALSE(is_solid_at(masked, 0, 0, {0.2F, 0.2F}));
    document["materials"][0]["alphaMode"] = "BLEND";
    const Scene blended = import(document);
    EXPECT_TRUE(is_solid_at(blended, 0, 0, {0.2F, 0.2F}));
    EXPECT_TRUE(mentions(blended.report.unused, "BLEND"));
}

TEST_F(ImportGltf, NamesWhatTheBakeCannotUse) {
    json document = test::gltf_triangle();
    document["materials"][0]["emissiveFactor"] = {1, 0.5, 0};
    document["materials"][0]["extensions"] = {
        {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
        {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}};
    document["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_clearcoat",
                                  "KHR_lights_punctual"};
    document["extensions"] = {
        {"KHR_lights_punctual", {{"lights", {{{"type", "point"}, {"name", "lamp"}}}}}}};
    document["nodes"].push_back(
        {{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    document["nodes"].push_back({{"name", "second"}, {"camera", 0}});
    document["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = import(document);
    for (const char* word : {"emission", "transmission", "clear coat", "light 'lamp'"})
        EXPECT_TRUE(mentions(scene.report.unused, word)) << word;
}

TEST_F(ImportGltf, SeveralCamerasGiveTheFirst) {
    json document = test::gltf_triangle();
    document["cameras"].push_back(document["cameras"][0]);
    document["nodes"].push_back({{"name", "other"}, {"camera", 1}, {"translation", {9, 9, 9}}});
    document["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = import(document);
    expect_near(Imath::V3f(scene.frame.origin), {0, 0, 5});
    EXPECT_TRUE(mentions(scene.report.unused, "camera 'other'"));
}

TEST_F(ImportGltf, CameraOfTheCallerOverridesTheFile) {
    test::write_json(scratch_.path() / "scene.gltf", test::gltf_triangle());
    ImportOptions options;
    options.camera = {.eye = Imath::V3d(7, 7, 7), .look_at = Imath::V3d(0, 0, 0)};
    const Scene scene = import_scene(scratch_.path() / "scene.gltf", options);
    expect_near(Imath::V3f(scene.frame.origin), {7, 7, 7});
}

TEST_F(ImportGltf, BinaryFile) {
    test::write_text(scratch_.path() / "scene.glb", test::glb_triangle());
    EXPECT_EQ(import_scene(scratch_.path() / "scene.glb").triangle_count(), 1U);
}

TEST_F(ImportGltf, DegenerateTrianglesAreDroppedAndCounted) {
    const Scene scene = import(test::gltf_document({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}},
                                                   {0, 1, 2, 0, 0, 1, 0, 1, 3}));
    EXPECT_EQ(scene.triangle_count(), 1U);
    EXPECT_TRUE(mentions(scene.report.repairs, "2 degenerate"));
}

}  // namespace
}  // namespace relume::scene
