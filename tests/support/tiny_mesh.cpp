#include "tests/support/tiny_mesh.h"

#include "protocol/basis/cubemap.h"
#include "protocol/transport/visibility_field.h"
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

transport::VisibilityFieldBuilder random_visibility(const TinyMesh& tiny,
                                                    std::uint32_t n,
                                                    std::uint64_t seed) {
    constexpr double kOpenPart = 0.7;
    std::mt19937_64 random(seed);
    std::bernoulli_distribution is_open(kOpenPart);
    const std::size_t words = transport::words_of_visibility(n);
    transport::VisibilityFieldBuilder visibility(
        n, static_cast<std::uint32_t>(tiny.clusters.size()));
    std::size_t vertex = 0;
    for (std::uint32_t cluster = 0; cluster < tiny.clusters.size(); ++cluster) {
        const std::uint32_t count = tiny.clusters[cluster].vertices;
        std::vector<std::uint64_t> bits(words * count, 0);
        for (std::uint32_t i = 0; i < count; ++i, ++vertex) {
            const Imath::V3f& normal = tiny.surface.mesh.normals[vertex];
            for (std::size_t t = 0; t < basis::texel_count(n); ++t) {
                const Imath::V3d direction =
                    basis::direction_from_texel(n, basis::texel_from_index(n, t));
                if (direction.dot(Imath::V3d(normal)) > 0 && is_open(random)) {
                    bits[words * i + t / 64] |= std::uint64_t{1} << t % 64;
                }
            }
        }
        visibility.set_block(cluster, bits);
    }
    return visibility;
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

void write_tiny_mesh_transport(const std::filesystem::path& directory,
                               std::uint64_t seed,
                               std::uint32_t visibility_resolution) {
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
    const TinyTransportOptions options{.blocks_per_shard = 3, .seed = seed};
    if (visibility_resolution == 0) {
        write_random_transport(directory, manifest, options, &tiny.surface);
        return;
    }
    const transport::VisibilityFieldBuilder visibility =
        random_visibility(tiny, visibility_resolution, seed);
    write_random_transport(directory, manifest, options, &tiny.surface, &visibility);
}

}  // namespace relume::test
