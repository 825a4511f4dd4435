#include "tests/support/tiny_mesh.h"

#include "tests/support/surface_shapes.h"
#include "tests/support/tiny_transport.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace relume::test {
namespace {

constexpr std::uint32_t kMaterials = 6;
constexpr std::uint32_t kCells = 7;

std::uint32_t terms_of(std::uint32_t material) {
    return 1 + material % 5;
}
std::uint32_t lobes_of(std::uint32_t material) {
    return 1 + material % 4;
}

brdf::DirectionTable random_table(std::uint32_t depth, std::mt19937_64& random) {
    const brdf::TableShape shape{.rows = 5, .columns = 8, .depth = depth};
    std::uniform_real_distribution<float> value(0.1F, 1);
    std::vector<float> values(shape.value_count());
    std::generate(values.begin(), values.end(), [&] { return value(random); });
    return {shape, std::move(values)};
}

transport::SurfaceTexture random_texture(std::uint32_t width,
                                         std::uint32_t height,
                                         std::mt19937_64& random) {
    transport::SurfaceTexture texture{.width = width, .height = height, .rgb = {}};
    std::uniform_real_distribution<float> value(0, 1);
    for (std::size_t i = 0; i < std::size_t{3} * width * height; ++i) {
        texture.rgb.emplace_back(value(random));
    }
    return texture;
}

}  // namespace

TinyMesh tiny_mesh(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> value(0.2F, 1);
    TinyMesh tiny;
    tiny.surface.mesh = together(room(kCells, kMaterials), box(3, {0.2F, -0.3F, 0.1F}, 0.35F));
    tiny.surface.textures = {random_texture(16, 5, random), random_texture(4, 32, random)};
    for (std::uint32_t m = 0; m < kMaterials; ++m) {
        const std::uint32_t terms = terms_of(m);
        tiny.surface.brdfs.push_back({.name = "brdf" + std::to_string(m),
                                      .terms = terms,
                                      .lobes = lobes_of(m),
                                      .g = random_table(terms, random),
                                      .h = random_table(terms * lobes_of(m), random)});
        transport::MaterialRecord material{
            .name = "material" + std::to_string(m), .brdf = m, .lobes = {}};
        for (std::uint32_t l = 0; l < lobes_of(m); ++l) {
            material.lobes.push_back(
                {.colour = {value(random), value(random), value(random)},
                 .texture = l < 2 && m > 1 ? std::optional(l) : std::nullopt});
        }
        tiny.materials.push_back(std::move(material));
        // The room's faces, one after the other.
        tiny.clusters.push_back(
            {.vertices = (kCells + 1) * (kCells + 1), .terms = terms, .material = m});
    }
    const auto of_box = static_cast<std::uint32_t>(tiny.surface.mesh.vertex_count() -
                                                   std::size_t{6} * tiny.clusters[0].vertices);
    tiny.clusters.push_back({.vertices = of_box, .terms = terms_of(0), .material = 0});
    return tiny;
}

void write_tiny_mesh_transport(const std::filesystem::path& directory, std::uint64_t seed) {
    TinyMesh tiny = tiny_mesh(seed);
    transport::Manifest manifest;
    manifest.generator = "relume tests";
    manifest.fingerprint = seed;
    manifest.kind = transport::Kind::mesh;
    manifest.layout =
        transport::ReceiverLayout::vertex_clusters(transport::VertexClusters(tiny.clusters));
    manifest.block_basis = transport::BlockBasis::haar_line;
    manifest.signal_basis = basis::CubemapBasis::haar(8);
    manifest.stating_rows = 256;
    manifest.choosing_rows = 64;
    manifest.colour.channels = 1;
    manifest.colour.matrix = {{{1}, {1}, {1}}};
    manifest.camera.eye = {-0.5F, 0.4F, 0.6F};
    manifest.camera.tan_half_width = 1;
    manifest.camera.tan_half_height = 0.6F;
    manifest.mesh = transport::MeshSection{.frame = {.origin = {10, 20, 30}, .unit = 2},
                                           .view = {.width = 40, .height = 24},
                                           .materials = tiny.materials,
                                           .mesh = {},
                                           .brdfs = {},
                                           .textures = {}};
    write_random_transport(directory, manifest, {.blocks_per_shard = 3, .seed = seed},
                           &tiny.surface);
}

}  // namespace relume::test
