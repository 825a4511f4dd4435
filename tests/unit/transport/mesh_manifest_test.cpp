#include "protocol/transport/error.h"
#include "protocol/transport/manifest.h"
#include "tests/unit/transport/changed_manifest.h"

#include <gtest/gtest.h>

#include <functional>

namespace relume::transport {
namespace {

Manifest sample() {
    Manifest manifest;
    manifest.generator = "test";
    manifest.kind = Kind::mesh;
    manifest.block_basis = BlockBasis::haar_line;
    manifest.layout = ReceiverLayout::vertex_clusters(
        VertexClusters({{.vertices = 256, .terms = 1, .material = 0},
                        {.vertices = 7, .terms = 4, .material = 1}}));
    manifest.signal_basis = basis::CubemapBasis::haar(8);
    manifest.stating_rows = 64;
    manifest.choosing_rows = 32;
    manifest.colour.matrix = {{{1}, {0.5F}, {0.25F}}};
    manifest.mesh =
        MeshSection{.frame = {.origin = {1e7, 0.1, -3}, .unit = 0.125},
                    .view = {.width = 640, .height = 480},
                    .materials = {{.name = "floor",
                                   .brdf = 0,
                                   .lobes = {{.colour = {1, 0.5F, 0}, .texture = 0}}},
                                  {.name = "post",
                                   .brdf = 1,
                                   .lobes = {{.colour = {0, 0, 0}, .texture = {}},
                                             {.colour = {0.25F, 1, 1}, .texture = 3}}}},
                    .mesh = {.file = "mesh.bin", .bytes = 1, .checksum = 2},
                    .brdfs = {.file = "brdfs.bin", .bytes = 3, .checksum = 4},
                    .textures = {.file = "textures.bin", .bytes = 5, .checksum = 6}};
    manifest.columns.file = "columns.bin";
    manifest.receivers.file = "receivers.bin";
    manifest.sketch.file = "sketch.bin";
    manifest.shards = {{.file = "shards/0",
                        .bytes = 1,
                        .header_checksum = 2,
                        .first_block = 0,
                        .block_count = 5}};
    return manifest;
}

std::string changed(const std::function<void(nlohmann::json&)>& change) {
    return changed_text(sample(), change);
}

TEST(MeshManifest, ComesBackFromItsText) {
    const std::string text = text_from_manifest(sample());
    const Manifest again = manifest_from_text(text, "m");
    EXPECT_EQ(text_from_manifest(again), text);
    EXPECT_EQ(again.layout.clusters(), sample().layout.clusters());
    EXPECT_EQ(again.mesh->materials, sample().mesh->materials);
    EXPECT_EQ(again.mesh->frame, sample().mesh->frame);
    EXPECT_EQ(again.mesh->view, sample().mesh->view);
    EXPECT_EQ(again.block_basis, BlockBasis::haar_line);
    EXPECT_EQ(again.mesh->textures.checksum, 6U);
}

TEST(MeshManifest, MaterialsMayHaveHoles) {
    Manifest manifest = sample();
    manifest.mesh->materials[1].cutout = CutoutRecord{.texture = 2, .cutoff = 0.25F};
    const Manifest again = manifest_from_text(text_from_manifest(manifest), "m");
    EXPECT_EQ(again.mesh->materials, manifest.mesh->materials);
}

TEST(MeshManifest, BlocksMayHoldTheValuesThemselves) {
    Manifest manifest = sample();
    manifest.block_basis = BlockBasis::identity;
    const std::string text = text_from_manifest(manifest);
    EXPECT_NE(text.find("\"identity\""), std::string::npos);
    EXPECT_EQ(manifest_from_text(text, "m").block_basis, BlockBasis::identity);
}

TEST(MeshManifest, NamesWhatIsWrong) {
    struct Wrong {
        const char* place;
        std::function<void(nlohmann::json&)> change;
    };
    const auto mesh = [](const char* key, nlohmann::json value) {
        return [=](nlohmann::json& object) { object["mesh"][key] = value; };
    };
    const auto material = [](nlohmann::json value) {
        return [=](nlohmann::json& object) { object["mesh"]["materials"][1] = value; };
    };
    const Wrong wrong[] = {
        {"block_basis", [](auto& o) { o["block_basis"] = "haar"; }},
        {"block_basis", [](auto& o) { o["block_basis"] = "haar_tile"; }},
        {"block_basis", [](auto& o) { o.erase("block_basis"); }},
        {"mesh", [](auto& o) { o.erase("mesh"); }},
        {"files.brdfs", [](auto& o) { o["files"].erase("brdfs"); }},
        {"files.mesh.file", [](auto& o) { o["files"]["mesh"]["file"] = "../mesh.bin"; }},
        {"blocks", [](auto& o) { o["blocks"] = 6; }},
        {"mesh.clusters", mesh("clusters", nlohmann::json::array())},
        {"mesh.clusters", mesh("clusters", {{256, 1, 0}, {7, 4}})},
        {"mesh.clusters", mesh("clusters", {{256, 1, 0}, {7, 4, 2}})},
        {"mesh.clusters", mesh("clusters", {{256, 1, 0}, {7, -4, 1}})},
        {"clusters[0]", mesh("clusters", {{257, 1, 0}, {7, 4, 1}})},
        {"clusters[1]", mesh("clusters", {{256, 1, 0}, {7, 17, 1}})},
        {"mesh.frame.unit", mesh("frame", {{"origin", {0, 0, 0}}, {"unit", 0}})},
        {"mesh.frame.origin", mesh("frame", {{"origin", {0, 0}}, {"unit", 1}})},
        {"mesh.view.width", mesh("view", {{"width", 0}, {"height", 1}})},
        {"mesh.materials", mesh("materials", nlohmann::json::array())},
        {"mesh.materials[1].brdf",
         material({{"name", ""}, {"lobes", {{{"colour", {1, 1, 1}}}}}})},
        {"mesh.materials[1].lobes", material({{"name", ""}, {"brdf", 1}, {"lobes", {}}})},
        {"mesh.materials[1].lobes[0].colour",
         material({{"name", ""}, {"brdf", 1}, {"lobes", {{{"colour", {1, -1, 1}}}}}})},
        {"mesh.materials[1].cutout.texture", material({{"name", ""},
                                                       {"brdf", 1},
                                                       {"lobes", {{{"colour", {1, 1, 1}}}}},
                                                       {"cutout", {{"cutoff", 0.5}}}})},
        {"mesh.materials[1].cutout.cutoff",
         material({{"name", ""},
                   {"brdf", 1},
                   {"lobes", {{{"colour", {1, 1, 1}}}}},
                   {"cutout", {{"texture", 0}, {"cutoff", "half"}}}})},
        {"mesh.materials[1].cutout", material({{"name", ""},
                                               {"brdf", 1},
                                               {"lobes", {{{"colour", {1, 1, 1}}}}},
                                               {"cutout", 0.5}})},
        {"mesh.materials[1].lobes[0].texture",
         material({{"name", ""},
                   {"brdf", 1},
                   {"lobes", {{{"colour", {1, 1, 1}}, {"texture", -1}}}}})},
    };
    for (const auto& [place, change] : wrong) {
        try {
            (void)manifest_from_text(changed(change), "m");
            ADD_FAILURE() << place;
        } catch (const TransportError& error) {
            EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace relume::transport
