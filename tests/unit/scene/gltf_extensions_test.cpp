// Extensions: those that are read give what the plain file gives, others are refused or named.
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_import_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

namespace relume::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::mentions;

class GltfExtensions : public test::GltfImport {
  protected:
    // A texture of one row, red left and green right, as texture 0 of the document.
    void add_red_green(GltfBuilder& builder) {
        test::write_red_green(scratch_.path() / "rg.png");
        builder.document["images"] = {{{"uri", "rg.png"}}};
        builder.document["textures"] = {{{"source", 0}}};
    }
};

void expect_near(const Imath::V3f& a, const Imath::V3f& b, float tolerance = 1e-4F) {
    EXPECT_LT((a - b).length(), tolerance) << a << " and " << b;
}

TEST_F(GltfExtensions, RequiredAndNotSupportedIsRefusedByName) {
    for (const char* name :
         {"KHR_texture_basisu", "KHR_materials_transmission", "KHR_lights_punctual",
          "VENDOR_invented", "KHR_meshopt_compression", "MSFT_texture_dds"}) {
        GltfBuilder builder(test::gltf_triangle());
        builder.document["extensionsUsed"] = {name};
        builder.document["extensionsRequired"] = {name};
        EXPECT_NE(refusal(builder, SceneFault::unsupported_extension).find(name),
                  std::string::npos);
    }
    GltfBuilder builder(test::gltf_triangle());
    builder.document["extensionsRequired"] = {"KHR_mesh_quantization", "A\nB"};
    EXPECT_NE(refusal(builder, SceneFault::unsupported_extension).find("A\\x0aB"),
              std::string::npos);
    builder.document["extensionsRequired"] = {1};
    (void)refusal(builder, SceneFault::corrupt_file);
}

TEST_F(GltfExtensions, UsedAndNotSupportedIsNamed) {
    GltfBuilder builder(test::gltf_triangle());
    json& extensions = builder.document["materials"][0]["extensions"];
    const std::vector<std::pair<std::string, json>> used{
        {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}},
        {"KHR_materials_sheen", {{"sheenColorFactor", {0, 0, 1}}}},
        {"KHR_materials_iridescence", {{"iridescenceFactor", 1}}},
        {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}},
        {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
        {"KHR_materials_volume", {{"thicknessFactor", 1}}},
        {"KHR_materials_dispersion", {{"dispersion", 1}}},
        {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 1}}},
        {"VENDOR_materials_unheard_of", {{"anything", 1}}}};
    for (const auto& [name, value] : used)
        extensions[name] = value;
    builder.document["nodes"][0]["extensions"] = {{"MSFT_lod", {{"ids", {0}}}}};
    builder.document["asset"]["extensions"] = {{"KHR_xmp_json_ld", {{"packet", 0}}}};
    const Scene scene = import(builder);
    for (const auto& [name, value] : used)
        EXPECT_TRUE(mentions(scene.report.unused, name)) << name;
    EXPECT_TRUE(mentions(scene.report.unused, "MSFT_lod"));
    EXPECT_FALSE(mentions(scene.report.unused, "KHR_xmp_json_ld"));
    // A factor of zero switches them off.
    extensions = {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0}}},
                  {"KHR_materials_sheen", json::object()}};
    builder.document["nodes"][0].erase("extensions");
    EXPECT_TRUE(import(builder).report.unused.empty());
}

TEST_F(GltfExtensions, BasisUniversalWithAFallbackIsNamed) {
    GltfBuilder builder(test::gltf_triangle());
    add_red_green(builder);
    builder.document["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 1}}}};
    builder.document["images"].push_back({{"uri", "rg.ktx2"}});
    builder.document["materials"][0]["pbrMetallicRoughness"] = {
        {"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}};
    const Scene scene = import(builder);
    EXPECT_EQ(scene.textures.size(), 1U);
    EXPECT_TRUE(mentions(scene.report.unused, "KHR_texture_basisu"));
    builder.document["textures"][0].erase("source");
    EXPECT_TRUE(mentions(import(builder).report.unused, "only as KHR_texture_basisu"));
}

// Each texture has its own transform; a texCoord in the transform goes before the texture's.
TEST_F(GltfExtensions, TextureTransformsBelongToTextures) {
    GltfBuilder builder(test::gltf_triangle());
    add_red_green(builder);
    builder.attributes()["TEXCOORD_3"] = builder.accessor_of(
        std::vector<Imath::V2f>(3, Imath::V2f(0.25F, 0.5F)), test::kFloat, "VEC2");
    const json moved = {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"texCoord", 3}}}};
    builder.document["materials"][0]["pbrMetallicRoughness"] = {
        {"baseColorTexture", {{"index", 0}, {"texCoord", 0}, {"extensions", moved}}},
        {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 3}}},
        {"metallicFactor", 1}};
    const Scene scene = import(builder);
    const auto point = test::surface_at(scene, 0.05F, 0.05F);
    ASSERT_TRUE(point);
    // Moved to u = 0.75: green. Not moved, red: roughness × 0, metallic × 0.
    expect_near(point->bsdf.diffuse_colour(), {0, 1, 0});
    EXPECT_EQ(point->bsdf.alpha(), Bsdf::kMinRoughness * Bsdf::kMinRoughness);
    EXPECT_TRUE(scene.report.unused.empty());
}

TEST_F(GltfExtensions, SpecularAndIndexOfRefractionWithTextures) {
    GltfBuilder builder(test::gltf_triangle());
    add_red_green(builder);
    builder.document["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    json& extensions = builder.document["materials"][0]["extensions"];
    extensions = {{"KHR_materials_ior", {{"ior", 2.0}}},
                  {"KHR_materials_specular",
                   {{"specularFactor", 0.5},
                    {"specularColorFactor", {2, 2, 2}},
                    {"specularColorTexture", {{"index", 0}}}}}};
    // ((2 − 1)/(2 + 1))²·2·0.5 in red, nothing in green.
    const auto point = test::surface_at(import(builder), 0.25F, 0.1F);
    ASSERT_TRUE(point);
    expect_near(point->bsdf.specular_colour(), {1 / 9.0F, 0, 0});
    EXPECT_FLOAT_EQ(point->bsdf.grazing(), 0.5F);
    extensions = {{"KHR_materials_ior", {{"ior", 0}}}};
    expect_near(test::surface_at(import(builder), 0.25F, 0.1F)->bsdf.specular_colour(),
                Imath::V3f(1));
}

TEST_F(GltfExtensions, AlphaOfVertexColoursMakesHoles) {
    GltfBuilder builder(test::gltf_triangle());
    builder.attributes()["COLOR_0"] = builder.accessor_of(
        std::vector<std::array<std::uint8_t, 4>>{
            {{255, 255, 255, 0}}, {{255, 255, 255, 255}}, {{255, 255, 255, 0}}},
        test::kUnsignedByte, "VEC4", true);
    builder.document["materials"][0]["alphaMode"] = "MASK";
    const Scene scene = import(builder);
    EXPECT_FALSE(is_solid_at(scene, 0, 0, {0.1F, 0.1F}));
    EXPECT_TRUE(is_solid_at(scene, 0, 0, {0.9F, 0.05F}));
}

}  // namespace
}  // namespace relume::scene
