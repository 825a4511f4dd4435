#include "protocol/transport/surface.h"

#include "protocol/brdf/brdf_file.h"
#include "protocol/brdf/error.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <cstdint>

namespace relume::transport {
namespace {

[[noreturn]] void fail(std::string_view where,
                       std::uint64_t found,
                       const std::string& expected) {
    throw TransportError(fmt::format("{}: found {}, expected {}", where, found, expected));
}

std::vector<brdf::FactoredBrdf> read_brdfs(const SurfaceFiles::File& file) {
    try {
        return brdf::brdfs_from_bytes(file.name, file.bytes);
    } catch (const brdf::BrdfError& error) {
        throw TransportError(error.what());
    }
}

void check_materials(const Manifest& manifest, const Surface& surface) {
    const std::vector<MaterialRecord>& materials = manifest.mesh->materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const auto where = [&](const char* key) {
            return fmt::format("manifest.mesh.materials[{}].{}", i, key);
        };
        if (materials[i].brdf >= surface.brdfs.size()) {
            fail(where("brdf"), materials[i].brdf,
                 fmt::format("one of {}", surface.brdfs.size()));
        }
        const brdf::FactoredBrdf& brdf = surface.brdfs[materials[i].brdf];
        if (materials[i].lobes.size() != brdf.lobes) {
            fail(where("lobes"), materials[i].lobes.size(), fmt::format("{}", brdf.lobes));
        }
        for (const LobeRecord& lobe : materials[i].lobes) {
            if (lobe.texture && *lobe.texture >= surface.textures.size()) {
                fail(where("lobes"), *lobe.texture,
                     fmt::format("one of {} textures", surface.textures.size()));
            }
        }
    }
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const auto& cutout = materials[i].cutout;
        if (cutout && cutout->texture >= surface.textures.size()) {
            fail(fmt::format("manifest.mesh.materials[{}].cutout", i), cutout->texture,
                 fmt::format("one of {} textures", surface.textures.size()));
        }
    }
    const std::span<const Cluster> clusters = manifest.layout.clusters().clusters();
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const std::uint32_t terms = surface.brdfs[materials[clusters[i].material].brdf].terms;
        if (clusters[i].terms != terms) {
            fail(fmt::format("manifest.mesh.clusters[{}]", i), clusters[i].terms,
                 fmt::format("the {} terms of its material", terms));
        }
    }
}

std::vector<std::uint32_t> material_from_vertex(const VertexClusters& clusters) {
    std::vector<std::uint32_t> materials;
    for (const Cluster& cluster : clusters.clusters()) {
        materials.insert(materials.end(), cluster.vertices, cluster.material);
    }
    return materials;
}

}  // namespace

bool is_solid_at(const Surface& surface,
                 const CutoutRecord& cutout,
                 std::uint32_t triangle,
                 float weight_1,
                 float weight_2) {
    const auto& uvs = surface.mesh.triangles[triangle].uvs;
    const Imath::V2f uv = surface.mesh.uvs[uvs[0]] * (1 - weight_1 - weight_2) +
                          surface.mesh.uvs[uvs[1]] * weight_1 +
                          surface.mesh.uvs[uvs[2]] * weight_2;
    return red_at(surface.textures[cutout.texture], uv) >= cutout.cutoff;
}

Surface surface_from_files(const Manifest& manifest, const SurfaceFiles& files) {
    Surface surface{.mesh = surface_mesh_from_bytes(files.mesh.bytes, files.mesh.name),
                    .brdfs = read_brdfs(files.brdfs),
                    .textures = textures_from_bytes(files.textures.bytes, files.textures.name)};
    check_surface_materials(surface.mesh, material_from_vertex(manifest.layout.clusters()),
                            files.mesh.name);
    check_materials(manifest, surface);
    return surface;
}

}  // namespace relume::transport
